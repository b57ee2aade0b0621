/// `talus info`: prints a summary of a run.

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/analysis_report.h"
#include "app/commands.h"
#include "app/json.h"
#include "app/options.h"
#include "base/errors.h"
#include "base/hash.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "io/run_file.h"
#include "scenario/scenario.h"
#include "scenario/scripted_command.h"
#include "session/command.h"
#include "session/run_header.h"
#include "session/schedule.h"

namespace talus::app {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double figure(const Figures& figures, const std::string& name, double otherwise = none) {
  return find_value(figures, name).value_or(otherwise);
}

std::string in_degrees(double angle) { return degrees_text(angle, 3) + " deg"; }

/// Entries that depend on the stored scenario; unset if this version cannot read it.
struct ScenarioFacts {
  double tolerance = none;           ///< tolerance of the solver for a bed at rest
  bool lowered = false;              ///< after failure
  std::vector<std::string> waiting;  ///< commands that a complete run did not reach
};

ScenarioFacts read_scenario(const io::RunFile& run, const std::string& path) {
  ScenarioFacts facts;
  try {
    const scenario::Scenario scenario = runs::stored_scenario(run.header(), path);
    facts.tolerance = scenario.solver.tolerance;
    facts.lowered = scenario.tilt.after_failure == scenario::AfterFailure::lower;
    if (scenario.commands.empty() || !run.complete()) return facts;
    const bool follows = follows_failure(scenario);
    const session::Schedule end = session::stored_schedule(run.checkpoint(), follows, path);
    for (const std::size_t k : session::waiting_commands(scenario, end)) {
      const scenario::ScriptedCommand& command = scenario.commands[k];
      facts.waiting.push_back(fmt::format("{}: {}, {}", scenario::command_section(k),
                                          session::command_text(scenario::command_of(command)),
                                          scenario::moment_text(command)));
    }
  } catch (const Error&) {
  }
  return facts;
}

void add_branch(std::vector<Fact>& facts, const io::RunHeader& header) {
  const std::optional<io::BranchOrigin>& branch = header.branch;
  const double rate = branch ? figure(branch->start.reals, "tilt_rate") : none;
  const bool has_rate = !std::isnan(rate), has_history = branch && !branch->history.empty();
  facts.push_back({branch ? "branch of" : "",
                   branch ? fmt::format("{}, frame {}, at {}, step {}; state hash of that run: {}",
                                        branch->run, branch->frame, in_degrees(branch->start.world.tilt),
                                        branch->start.world.step, branch->run_hash)
                          : "",
                   "branch_of", branch ? Json(branch->run) : Json()});
  facts.push_back({"", "", "branch_frame", branch ? Json(branch->frame) : Json()});
  facts.push_back({"", "", "branch_step", branch ? Json(branch->start.world.step) : Json()});
  facts.push_back({"", "", "branch_run_hash", branch ? Json(branch->run_hash) : Json()});
  facts.push_back({has_rate ? "began with" : "",
                   fmt::format("a tilt rate of {:.4g} deg/s, set by a command before", degrees(rate)),
                   "branch_tilt_rate_deg_per_s", degrees(rate)});
  facts.push_back({has_history ? "before" : "", branch ? branch->history : "", "branch_history",
                   branch ? Json(branch->history) : Json()});
}

/// Friction at the beginning of the tilt or the branch, and until the bed was at rest.
void add_friction(std::vector<Fact>& facts, const io::RunHeader& header) {
  Friction friction = header.friction;
  // Earlier versions kept the scenario of the run, although a command had set another friction.
  if (header.branch) friction.grains = figure(header.branch->start.reals, "friction", friction.grains);
  const auto text = [&](const Friction& shown) {
    return fmt::format("{:g}", shown.grains) +
           (header.statics.periodic ? ""
                                    : fmt::format(" between grains and {:g} with the walls", shown.walls));
  };
  const Friction& deposition = header.deposition_friction;
  const bool is_same = header.branch || text(friction) == text(deposition);
  facts.push_back(
      {"friction",
       text(friction) + (is_same ? "" : fmt::format("; until the bed was at rest {}", text(deposition))),
       "friction", friction.grains});
  facts.push_back({"", "", "wall_friction", friction.walls});
  facts.push_back({"", "", "deposition_friction", deposition.grains});
  facts.push_back({"", "", "deposition_wall_friction", deposition.walls});
}

void add_frames(std::vector<Fact>& facts, const io::RunFile& run) {
  const std::size_t count = run.frame_count(), flow = run.all_frame_tilts().size() - count;
  const std::span<const double> tilts = run.frame_tilts();
  const bool any = count > 0;
  const double first = any ? tilts.front() : none, last = any ? tilts.back() : none,
               lowest = any ? std::ranges::min(tilts) : none, highest = any ? std::ranges::max(tilts) : none;
  std::string text = std::to_string(count);
  if (any && run.goes_by_time())
    text += fmt::format(", tilt between {} and {} {}, last {}", in_degrees(lowest), in_degrees(highest),
                        run.has_program() ? "by a programme" : "by commands", in_degrees(last));
  else if (any)
    text += fmt::format(", tilt {} to {}", in_degrees(first), in_degrees(last));
  if (flow > 0) text += fmt::format(", {} after failure", flow);
  if (!run.has_frames()) text += "; only times and tilts of the frames are kept (--keep analysis)";
  facts.push_back({"frames", text, "frames", count});
  facts.push_back({"", "", "frames_after_failure", flow});
  facts.push_back({"", "", "has_frames", run.has_frames()});
  facts.push_back({"", "", "tilt_first_deg", degrees(first)});
  facts.push_back({"", "", "tilt_last_deg", degrees(last)});
  facts.push_back({"", "", "tilt_lowest_deg", degrees(lowest)});
  facts.push_back({"", "", "tilt_highest_deg", degrees(highest)});
}

void add_failure(std::vector<Fact>& facts, const io::RunFile& run, bool lowered) {
  const io::Checkpoint& end = run.checkpoint();
  const double theta_c = figure(end.results, "theta_c"), theta_r = figure(end.results, "theta_r");
  facts.push_back({"", "", "tilt_deg", degrees(end.world.tilt)});
  facts.push_back({"theta_c",
                   std::isnan(theta_c)
                       ? "none: the slope has not failed"
                       : in_degrees(theta_c) + (lowered ? "" : beyond_repose(theta_c, end.world.tilt)),
                   "theta_c_deg", degrees(theta_c)});
  facts.push_back({find_value(end.results, "theta_r") ? "theta_r" : "",
                   std::isnan(theta_r)
                       ? "none: no flow after failure has come to rest"
                       : fmt::format("{}, at a tilt of {}", in_degrees(theta_r), in_degrees(end.world.tilt)),
                   "theta_r_deg", degrees(theta_r)});
}

void add_steps(std::vector<Fact>& facts, const io::RunFile& run, double tolerance) {
  std::size_t unconverged = 0;
  double worst = none;
  for (const StepRow& row : run.steps()) {
    if (at(row, StepField::phase) != 1.0) continue;
    worst = std::fmax(worst, at(row, StepField::residual));
    if (at(row, StepField::converged) == 0.0) ++unconverged;
  }
  facts.push_back({"solver tolerance", number_text(tolerance), "solver_tolerance", tolerance});
  facts.push_back(
      {"worst residual",
       fmt::format("{} in the tilt, {} of its steps not converged", number_text(worst), unconverged),
       "residual_max", worst});
  facts.push_back({"", "", "unconverged_steps", unconverged});
  facts.push_back({"steps", std::to_string(run.steps().size()), "steps", run.steps().size()});
}

void add_commands(std::vector<Fact>& facts, const io::RunFile& run, const std::vector<std::string>& waiting) {
  const std::vector<Command> commands = session::given_commands(run.commands());
  const World& end = run.checkpoint().world;
  std::vector<ObservableRow> rows = run.all_observables();
  if (run.has_state()) rows = session::rows_up_to(rows, end.step, end.time, end.tilt);
  std::string text = std::to_string(commands.size());
  Json given = Json::array();
  for (const Command& command : commands) {
    const double tilt = session::tilt_before(command, commands, rows);  // NaN during the deposition
    const std::string what = session::command_text(command);
    text += fmt::format("\n  after step {:<12} {:<12} {}", command.step,
                        std::isnan(tilt) ? "deposition" : in_degrees(tilt), what);
    given.push_back({{"step", command.step}, {"tilt_deg", degrees(tilt)}, {"command", what}});
  }
  facts.push_back({commands.empty() ? "" : "commands", text, "commands", commands.size()});
  facts.push_back({"", "", "commands_given", given});
  for (const std::string& command : waiting) facts.push_back({"not carried out", command});
  facts.push_back({"", "", "commands_not_carried_out", waiting});
}

void add_own(std::vector<Fact>& facts, const io::RunFile& run) {
  std::string lines;
  Json given = Json::array();
  for (const OwnQuantity& own : run.own()) {
    const std::string what =
        visible_word(own.label) + (own.unit.empty() ? "" : " in " + visible_word(own.unit));
    const char* const rows = own.of_grains ? "grains" : "contacts";
    lines += fmt::format("\n  {:<30}{}, of {}", own.name, what, rows);
    given.push_back({{"name", own.name}, {"label", own.label}, {"unit", own.unit}, {"of", rows}});
  }
  facts.push_back({run.own().empty() ? "" : "values of scripts", lines, "own", given});
}

std::vector<Fact> facts_of_run(const io::RunFile& run, const std::string& path) {
  const io::RunHeader& header = run.header();
  const io::Checkpoint& end = run.checkpoint();
  const ScenarioFacts scenario = read_scenario(run, path);
  const Index grains = header.statics.free_count,
              floor = static_cast<Index>(header.statics.radius.size()) - grains;
  const auto fact = [&](const char* name) { return find_value(header.provenance, name).value_or("unknown"); };
  std::vector<Fact> facts = {
      {"run",
       path + (run.complete() ? "" : fmt::format(" (not complete, at {})", in_degrees(end.world.tilt))),
       "path", path},
      {"", "", "complete", run.complete()}};
  if (!run.complete()) facts.push_back({"to continue", fmt::format("talus run --resume {}", path)});
  if (!run.lost().empty()) facts.push_back({"lost", run.lost() + " (the run was repaired)"});
  add_branch(facts, header);
  facts.push_back({"version", runs::version_of(header.provenance), "talus_version", fact("version")});
  facts.push_back({"", "", "git_hash", fact("git_hash")});
  facts.push_back({"seed", std::to_string(header.seed), "seed", header.seed});
  facts.push_back({"grains", fmt::format("{} free, {} on the floor", grains, floor), "grains", grains});
  facts.push_back({"", "", "floor_grains", floor});
  add_friction(facts, header);
  add_frames(facts, run);
  add_failure(facts, run, scenario.lowered);
  add_steps(facts, run, scenario.tolerance);
  add_commands(facts, run, scenario.waiting);
  const std::string hash = run.has_state() ? hash_text(state_hash(end.world)) : "none";
  facts.push_back({"state hash", hash, "state_hash", hash});
  const auto section = [&facts](const char* title, const char* key, const Figures& figures,
                                const char* format) {
    std::string lines;
    for (const auto& [name, value] : figures)
      lines += fmt::format("\n  {:<30}{}", name, number_text(value, format));
    facts.push_back({title, lines, key, object_of(figures)});
  };
  section("results (SI)", "results", end.results, "{:.4g}");
  section("timing (s)", "timing", end.timing, "{:.3f}");
  add_own(facts, run);
  facts.push_back({"", "", "provenance", object_of(header.provenance)});
  return facts;
}

}  // namespace

void add_info_command(CLI::App& app) {
  struct Arguments {
    std::string path;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("info", "Print a summary of a run");
  add_run_argument(*command, arguments->path);
  command->add_flag("--json", arguments->json,
                    "Print JSON: names ending in _deg are in degrees, all others in SI units, theta_c in "
                    "results in radians");
  command->callback([arguments] {
    print_facts(facts_of_run(io::RunFile::open(arguments->path), arguments->path), arguments->json, 20);
  });
}

}  // namespace talus::app
