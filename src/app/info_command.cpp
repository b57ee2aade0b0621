/// `talus info`: prints a summary of a run.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <limits>
#include <memory>
#include <optional>

#include "app/analysis_report.h"
#include "app/commands.h"
#include "app/json.h"
#include "app/terminal.h"
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

struct RunInfo {
  std::string path;
  bool complete = false;
  std::uint64_t seed = 0;
  Index grains = 0;  ///< free grains
  Index floor_grains = 0;
  bool periodic = false;
  std::size_t frames = 0;       ///< frames of the tilt
  std::size_t flow_frames = 0;  ///< frames after failure
  bool has_frames = true;       ///< false: only times and tilts of the frames are kept
  double tilt_first = none;     ///< rad, tilt of the first frame
  double tilt_last = none;
  std::string course;  ///< "by a programme" or "by commands"; empty: the tilt only grows
  double tilt_lowest = none, tilt_highest = none;  ///< rad, extremes over the frames of the tilt
  double tilt = 0.0;                               ///< rad, tilt of the last state
  bool lowered = false;                            ///< after failure
  std::size_t steps = 0;
  Friction friction;             ///< friction at the beginning of the tilt or the branch
  Friction deposition_friction;  ///< friction until the bed was at rest; none of a branch
  double branch_rate = none;     ///< rad/s, set by a command before the branch began
  std::vector<Command> commands;
  std::vector<std::string> waiting;   ///< commands of the scenario that a complete run did not reach
  std::vector<double> command_tilts;  ///< rad; NaN during the deposition
  std::size_t unconverged_steps = 0;  ///< unconverged steps of the tilt
  double solver_tolerance = none;     ///< tolerance for a bed at rest
  double residual_max = none;         ///< worst natural-map residual of the steps of the tilt
  std::string state_hash;
  std::optional<io::BranchOrigin> branch;
  std::string lost;  ///< pieces lost before the run was repaired
  Facts provenance;
  Figures results;  ///< SI
  Figures timing;   ///< s
};

std::string fact(const Facts& facts, const std::string& name) {
  return find_value(facts, name).value_or("unknown");
}

double figure(const Figures& figures, const std::string& name) {
  return find_value(figures, name).value_or(none);
}

double figure_or(const Figures& figures, const std::string& name, double otherwise) {
  return find_value(figures, name).value_or(otherwise);
}

/// Reads the entries that depend on the stored scenario; leaves them unset if this version cannot read it.
void read_scenario(const io::RunFile& run, RunInfo& info) try {
  const scenario::Scenario scenario = runs::stored_scenario(run.header(), info.path);
  info.solver_tolerance = scenario.solver.tolerance;
  info.lowered = scenario.tilt.after_failure == scenario::AfterFailure::lower;
  if (scenario.commands.empty() || !run.complete()) return;
  const bool follows = scenario.tilt.after_failure != scenario::AfterFailure::stop;
  const session::Schedule end = session::stored_schedule(run.checkpoint(), follows, info.path);
  for (const std::size_t k : session::waiting_commands(scenario, end)) {
    const scenario::ScriptedCommand& command = scenario.commands[k];
    info.waiting.push_back(fmt::format("{}: {}, {}", scenario::command_section(k),
                                       session::command_text(scenario::command_of(command)),
                                       scenario::moment_text(command)));
  }
} catch (const Error&) {
}

void count_steps(const std::vector<StepRow>& steps, RunInfo& info) {
  info.steps = steps.size();
  for (const StepRow& row : steps) {
    if (at(row, StepField::phase) != 1.0) continue;
    info.residual_max = std::fmax(info.residual_max, at(row, StepField::residual));
    if (at(row, StepField::converged) == 0.0) ++info.unconverged_steps;
  }
}

std::vector<double> tilts_of(const std::vector<Command>& commands, const io::RunFile& run) {
  const World& end = run.checkpoint().world;
  std::vector<ObservableRow> rows = run.all_observables();
  if (run.has_state()) rows = session::rows_up_to(rows, end.step, end.time, end.tilt);
  std::vector<double> tilts;
  for (const Command& command : commands) tilts.push_back(session::tilt_before(command, commands, rows));
  return tilts;
}

RunInfo read_info(const std::string& path) {
  const io::RunFile run = io::RunFile::open(path);
  const RunStatics& statics = run.header().statics;
  RunInfo info;
  info.path = path;
  info.complete = run.complete();
  info.seed = run.header().seed;
  info.grains = statics.free_count;
  info.floor_grains = static_cast<Index>(statics.radius.size()) - statics.free_count;
  info.periodic = statics.periodic;
  info.frames = run.frame_count();
  info.flow_frames = run.all_frame_tilts().size() - info.frames;
  info.has_frames = run.has_frames();
  if (info.frames > 0) {
    info.tilt_first = run.frame_tilts().front();
    info.tilt_last = run.frame_tilts().back();
    info.tilt_lowest = std::ranges::min(run.frame_tilts());
    info.tilt_highest = std::ranges::max(run.frame_tilts());
  }
  if (run.goes_by_time()) info.course = run.has_program() ? "by a programme" : "by commands";
  info.tilt = run.checkpoint().world.tilt;
  count_steps(run.steps(), info);
  info.commands = session::given_commands(run.commands());
  info.branch = run.header().branch;
  info.friction = run.header().friction;
  info.deposition_friction = run.header().deposition_friction;
  if (info.branch) {
    // Earlier versions kept the scenario of the run, although a command had set another friction.
    info.friction.grains = figure_or(info.branch->start.reals, "friction", info.friction.grains);
    info.branch_rate = figure(info.branch->start.reals, "tilt_rate");
  }
  info.command_tilts = tilts_of(info.commands, run);
  read_scenario(run, info);
  info.state_hash = run.has_state() ? hash_text(state_hash(run.checkpoint().world)) : "none";
  info.lost = run.lost();
  info.provenance = run.header().provenance;
  info.results = run.checkpoint().results;
  info.timing = run.checkpoint().timing;
  return info;
}

Json commands_of(const RunInfo& info) {
  Json all = Json::array();
  for (std::size_t k = 0; k < info.commands.size(); ++k)
    all.push_back({{"step", info.commands[k].step},
                   {"tilt_deg", degrees(info.command_tilts[k])},
                   {"command", session::command_text(info.commands[k])}});
  return all;
}

void print_json(const RunInfo& info) {
  const std::optional<io::BranchOrigin>& branch = info.branch;
  const Json json = {{"path", info.path},
                     {"complete", info.complete},
                     {"seed", info.seed},
                     {"grains", info.grains},
                     {"floor_grains", info.floor_grains},
                     {"frames", info.frames},
                     {"frames_after_failure", info.flow_frames},
                     {"has_frames", info.has_frames},
                     {"tilt_first_deg", degrees(info.tilt_first)},
                     {"tilt_last_deg", degrees(info.tilt_last)},
                     {"tilt_lowest_deg", degrees(info.tilt_lowest)},
                     {"tilt_highest_deg", degrees(info.tilt_highest)},
                     {"tilt_deg", degrees(info.tilt)},
                     {"theta_c_deg", degrees(figure(info.results, "theta_c"))},
                     {"theta_r_deg", degrees(figure(info.results, "theta_r"))},
                     {"solver_tolerance", info.solver_tolerance},
                     {"residual_max", info.residual_max},
                     {"unconverged_steps", info.unconverged_steps},
                     {"steps", info.steps},
                     {"friction", info.friction.grains},
                     {"wall_friction", info.friction.walls},
                     {"deposition_friction", info.deposition_friction.grains},
                     {"deposition_wall_friction", info.deposition_friction.walls},
                     {"branch_tilt_rate_deg_per_s", degrees(info.branch_rate)},
                     {"commands", info.commands.size()},
                     {"commands_given", commands_of(info)},
                     {"commands_not_carried_out", info.waiting},
                     {"state_hash", info.state_hash},
                     {"branch_of", branch ? Json(branch->run) : Json()},
                     {"branch_frame", branch ? Json(branch->frame) : Json()},
                     {"branch_step", branch ? Json(branch->start.world.step) : Json()},
                     {"branch_history", branch ? Json(branch->history) : Json()},
                     {"branch_run_hash", branch ? Json(branch->run_hash) : Json()},
                     {"talus_version", fact(info.provenance, "version")},
                     {"git_hash", fact(info.provenance, "git_hash")},
                     {"results", object_of(info.results)},
                     {"timing", object_of(info.timing)},
                     {"provenance", object_of(info.provenance)}};
  print("%s\n", json_text(json).c_str());
}

/// Prints a line; `value` may come from the file.
void print_line(const char* name, const std::string& value) { print("%-20s%s\n", name, value.c_str()); }

std::string in_degrees(double angle) { return degrees_text(angle, 3) + " deg"; }

std::string short_number(double value) { return std::isnan(value) ? "none" : fmt::format("{:.4g}", value); }

std::string tilts_text(const RunInfo& info) {
  if (!info.course.empty())
    return fmt::format(", tilt between {} and {} {}, last {}", in_degrees(info.tilt_lowest),
                       in_degrees(info.tilt_highest), info.course, in_degrees(info.tilt_last));
  return fmt::format(", tilt {} to {}", in_degrees(info.tilt_first), in_degrees(info.tilt_last));
}

std::string rest_text(const RunInfo& info) {
  const double theta_r = figure(info.results, "theta_r");
  return std::isnan(theta_r) ? "none: no flow after failure has come to rest"
                             : fmt::format("{}, at a tilt of {}", in_degrees(theta_r), in_degrees(info.tilt));
}

std::string friction_text(const RunInfo& info) {
  const auto text = [&](const Friction& friction) {
    return fmt::format("{:g}", friction.grains) +
           (info.periodic ? "" : fmt::format(" between grains and {:g} with the walls", friction.walls));
  };
  if (info.branch || text(info.friction) == text(info.deposition_friction)) return text(info.friction);
  return fmt::format("{}; until the bed was at rest {}", text(info.friction), text(info.deposition_friction));
}

void print_commands(const RunInfo& info) {
  print_line("commands", std::to_string(info.commands.size()));
  for (std::size_t k = 0; k < info.commands.size(); ++k) {
    const double tilt = info.command_tilts[k];
    print("  after step %-12lld %-12s %s\n", static_cast<long long>(info.commands[k].step),
          std::isnan(tilt) ? "deposition" : in_degrees(tilt).c_str(),
          session::command_text(info.commands[k]).c_str());
  }
}

void print_report(const RunInfo& info) {
  const double theta_c = figure(info.results, "theta_c");
  print_line("run",
             info.path + (info.complete ? "" : fmt::format(" (not complete, at {})", in_degrees(info.tilt))));
  if (!info.complete) print_line("to continue", fmt::format("talus run --resume {}", info.path));
  if (!info.lost.empty()) print_line("lost", info.lost + " (the run was repaired)");
  if (info.branch)
    print_line("branch of",
               fmt::format("{}, frame {}, at {}, step {}; state hash of that run: {}", info.branch->run,
                           info.branch->frame, in_degrees(info.branch->start.world.tilt),
                           info.branch->start.world.step, info.branch->run_hash));
  if (!std::isnan(info.branch_rate))
    print_line("began with", fmt::format("a tilt rate of {:.4g} deg/s, set by a command before",
                                         degrees(info.branch_rate)));
  if (info.branch && !info.branch->history.empty()) print_line("before", info.branch->history);
  print_line("version", runs::version_of(info.provenance));
  print_line("seed", std::to_string(info.seed));
  print_line("grains", fmt::format("{} free, {} on the floor", info.grains, info.floor_grains));
  print_line("friction", friction_text(info));
  print_line("frames",
             std::to_string(info.frames) + (info.frames == 0 ? "" : tilts_text(info)) +
                 (info.flow_frames == 0 ? "" : fmt::format(", {} after failure", info.flow_frames)) +
                 (info.has_frames ? "" : "; only times and tilts of the frames are kept (--keep analysis)"));
  print_line("theta_c", std::isnan(theta_c)
                            ? "none: the slope has not failed"
                            : in_degrees(theta_c) + (info.lowered ? "" : beyond_repose(theta_c, info.tilt)));
  if (find_value(info.results, "theta_r")) print_line("theta_r", rest_text(info));
  print_line("solver tolerance", short_number(info.solver_tolerance));
  print_line("worst residual", fmt::format("{} in the tilt, {} of its steps not converged",
                                           short_number(info.residual_max), info.unconverged_steps));
  print_line("steps", std::to_string(info.steps));
  if (!info.commands.empty()) print_commands(info);
  for (const std::string& command : info.waiting) print_line("not carried out", command);
  print_line("state hash", info.state_hash);
  print("results (SI)\n");
  for (const auto& [name, value] : info.results)
    print("  %-30s%s\n", name.c_str(), short_number(value).c_str());
  print("timing (s)\n");
  for (const auto& [name, value] : info.timing) print("  %-30s%.3f\n", name.c_str(), value);
}

}  // namespace

void add_info_command(CLI::App& app) {
  struct Arguments {
    std::string path;
    bool json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand("info", "Print a summary of a run");
  command->add_option("RUN", arguments->path, "Run file, or the name of an incomplete run")->required();
  command->add_flag("--json", arguments->json,
                    "Print JSON: names ending in _deg are in degrees, all others in SI units, theta_c in "
                    "results in radians");
  command->callback([arguments] {
    const RunInfo info = read_info(arguments->path);
    if (arguments->json)
      print_json(info);
    else
      print_report(info);
  });
}

}  // namespace talus::app
