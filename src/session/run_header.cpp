#include "session/run_header.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/hash.h"
#include "base/text.h"
#include "base/version.h"
#include "core/trigonometry.h"
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

std::vector<Given> commands_given(const io::RunFile& run, const Scenario& scenario) {
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
bool is_of_script(const Given& given, const scenario::ScriptedCommand& scripted, const Scenario& scenario) {
  const Command& one = given.command;
  if (one.kind != scripted.kind || one.x != scripted.x || one.y != scripted.y || one.grain != scripted.grain)
    return false;
  if (scripted.time) return std::abs(given.time - *scripted.time) <= 1.5 * scenario::time_step(scenario);
  // A command may have made the tilt faster than that of the scenario.
  constexpr double fastest = 100.0;  // deg/s
  return std::abs(given.tilt - scripted.at.value_or(0.0)) <= 1.5 * fastest * scenario::time_step(scenario);
}

/// Removes the commands that the scenario has.
void drop_scripted(std::vector<Given>& given, const Scenario& scenario) {
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

std::vector<std::string> departures(const io::RunFile& run, const Scenario& scenario, std::int64_t step) {
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
  std::string all = joined(departures, "; ");
  if (departures.size() <= most) return all;
  return fmt::format("{}, with hash {}", departures_text(departures), text_hash(all));
}

namespace {

constexpr const char* bed_fact = "bed_hash";

std::string bed_of(const Session& at_start) {
  const bool from_file = at_start.scenario().deposition.method == scenario::DepositionMethod::file;
  return from_file ? hash_text(state_hash(at_start.world())) : std::string();
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::string host_name() {
  char name[256] = "unknown";
  gethostname(name, sizeof name - 1);
  return name;
}

}  // namespace

RunOrigin with_bed(RunOrigin origin, const Session& at_start) {
  if (!origin.branch) origin.bed = bed_of(at_start);
  return origin;
}

std::string bed_of(const Facts& provenance) { return find_value(provenance, bed_fact).value_or(""); }

io::RunHeader run_header(const Session& session, const RunOrigin& origin) {
  io::RunHeader header;
  header.statics = run_statics(session.scenario(), session.world());
  header.friction = scenario::friction(session.scenario());
  header.deposition_friction = scenario::deposition_friction(session.scenario());
  header.scenario_given = origin.scenario_text;
  header.scenario_resolved = scenario::resolved_toml(session.scenario());
  header.seed = session.scenario().seed;
  header.provenance = {{"version", version},
                       {"git_hash", git_hash},
                       {"compiler", compiler},
                       {"flags", build_flags},
                       {"host", host_name()},
                       {"threads", std::to_string(origin.threads)},
                       {"start", utc_now()},
                       {"command", origin.command_line},
                       {"scenario_file", origin.scenario_file}};
  if (!origin.bed.empty()) header.provenance.emplace_back(bed_fact, origin.bed);
  if (origin.branch && !origin.branch->history.empty())
    header.provenance.emplace_back(io::history_fact, origin.branch->history);
  header.branch = origin.branch;
  return header;
}

void refuse_unfinished_replay(const io::RunHeader& header, const World& world, const std::string& path) {
  const std::optional<std::string> steps = find_value(header.provenance, "replay_steps");
  if (!steps || world.step >= std::atoll(steps->c_str())) return;
  const std::string run = find_value(header.provenance, "replay_of").value_or("RUN");
  throw Error(ExitCode::bad_data,
              "{} is a replay of {} that was stopped after {} of its {} steps, without the "
              "commands that follow; repeat it with: talus replay {} -o {} --overwrite",
              path, run, world.step, *steps, run, path);
}

Session session_at_start(const io::RunHeader& header, const std::string& name) {
  const Scenario scenario = runs::stored_scenario(header, name + ":/parameters");
  if (!header.branch) {
    Session session(scenario);
    const std::string bed = bed_of(header.provenance);
    if (bed.empty() || bed == bed_of(session)) return session;
    throw Error(ExitCode::bad_data,
                "{} (deposition.file) no longer holds the bed from which {} was computed; undo the change",
                visible(scenario.deposition.file), name);
  }
  check_branch_start(*header.branch, scenario, name);
  Session session(scenario, start_of(header.branch->start), name, "/branch");
  session.record_start();
  return session;
}

}  // namespace talus::session
