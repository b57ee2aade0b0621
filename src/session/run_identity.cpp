#include "session/run_identity.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <span>

#include "base/hash.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "scenario/scripted_command.h"
#include "session/command.h"
#include "session/frame_state.h"

namespace talus::session {
namespace {

/// A command with the moment at which it was given.
struct Given {
  Command command;
  double tilt = 0.0;  ///< deg; NaN in the deposition
  double time = 0.0;  ///< s since the tilt began
};

std::vector<Given> commands_given(const io::RunFile& run, const scenario::Scenario& scenario) {
  std::vector<Given> all;
  if (run.commands().empty()) return all;
  const World& end = run.checkpoint().world;
  std::vector<ObservableRow> rows = run.all_observables();
  if (run.has_state()) rows = rows_up_to(rows, end.step, end.time, end.tilt);
  const std::int64_t before = steps_before_tilt(run);
  for (const Command& command : run.commands())
    all.push_back({command, degrees(tilt_before(command, run.commands(), rows)),
                   static_cast<double>(command.step - before) * scenario::time_step(scenario)});
  return all;
}

/// Whether the run carried out a command of its scenario here, to the resolution of a step.
bool is_of_script(const Given& given, const scenario::ScriptedCommand& scripted,
                  const scenario::Scenario& scenario) {
  const Command& one = given.command;
  if (one.kind != scripted.kind || one.x != scripted.x || one.y != scripted.y || one.grain != scripted.grain)
    return false;
  if (scripted.time) return std::abs(given.time - *scripted.time) <= 1.5 * scenario::time_step(scenario);
  // A command may have made the tilt faster than that of the scenario.
  constexpr double fastest = 100.0;  // deg/s
  return std::abs(given.tilt - scripted.at.value_or(0.0)) <= 1.5 * fastest * scenario::time_step(scenario);
}

/// Removes the commands that the scenario has.
void drop_scripted(std::vector<Given>& given, const scenario::Scenario& scenario) {
  for (const scenario::ScriptedCommand& scripted : scenario.commands) {
    const auto found = std::ranges::find_if(
        given, [&](const Given& each) { return is_of_script(each, scripted, scenario); });
    if (found != given.end()) given.erase(found);
  }
}

std::string branch_text(const io::BranchOrigin& branch) {
  const io::Checkpoint& start = branch.start;
  std::string text = fmt::format("branch at {} deg", degrees_text(start.world.tilt, 2));
  if (const auto rate = find_value(start.reals, "tilt_rate"))
    text += fmt::format(" with a tilt rate of {:.4g} deg/s", degrees(*rate));
  if (find_value(start.integers, "drag_grain")) text += " with a dragged grain";
  if (!branch.history.empty()) text += " after " + branch.history;
  return text;
}

}  // namespace

std::string departure_text(const Command& command, double tilt, double time) {
  return command_text(command) +
         (std::isnan(tilt) ? " in the deposition"
                           : fmt::format(" at {} deg, {} s", fixed_text(tilt, 2), fixed_text(time, 2)));
}

std::vector<std::string> departures(const io::RunFile& run, const scenario::Scenario& scenario,
                                    std::int64_t step) {
  std::vector<std::string> found;
  if (run.header().branch) found.push_back(branch_text(*run.header().branch));
  std::vector<Given> given = commands_given(run, scenario);
  std::erase_if(given, [step](const Given& each) { return each.command.step >= step; });
  drop_scripted(given, scenario);
  for (const Given& each : given) found.push_back(departure_text(each.command, each.tilt, each.time));
  return found;
}

std::string departures_text(const std::vector<std::string>& departures) {
  if (departures.empty()) return "";
  return departures.front() +
         (departures.size() > 1 ? fmt::format(" and {} more", departures.size() - 1) : "");
}

std::string history_text(const std::vector<std::string>& departures) {
  constexpr std::size_t most = 5;
  if (departures.size() <= most) return joined(departures, "; ");
  const std::string all = joined(departures, "; ");
  return fmt::format("{}, with hash {}", departures_text(departures),
                     hash_text(hash_bytes(std::as_bytes(std::span(all)))));
}

}  // namespace talus::session
