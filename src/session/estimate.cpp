#include "session/estimate.h"

#include <sys/resource.h>
#include <sys/sysinfo.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <limits>

#include "base/errors.h"
#include "scenario/tilt_program.h"
#include "session/deposition.h"

namespace talus::session {
namespace {

// Measured on one core (x86-64, AVX2) with beds of L = 50 D, H = 20 D and L = 200 D, H = 40 D, tilted to
// failure; see docs/scenario.md.
constexpr double seconds_per_contact_and_iteration = 3.4e-9;
constexpr double seconds_per_contact_and_sweep = 15e-9;  // Gauss-Seidel
constexpr double contacts_per_grain = 1.9;               // including near contacts
constexpr double iterations_of_deposition = 150.0;
constexpr double iterations_of_tilt = 60.0;
constexpr double iterations_of_tilt_of_collapsed = 105.0;
constexpr double falls_until_rest = 5.0;         // times sqrt(H / g)
constexpr double gauss_seidel_iterations = 5.0;  // times those of the accelerated solver

constexpr double seconds_per_commit = 0.004;  // for a small bed
constexpr double seconds_per_commit_and_grain = 2.2e-6;

constexpr double bytes_of_process = 2e7;
constexpr double memory_per_grain = 2500.0;
constexpr double memory_of_packing = 3.5;  // times the size of the file

constexpr double bytes_of_file = 2e5;
constexpr double checkpoint_bytes_per_grain = 190.0;
constexpr double frame_bytes_per_grain = 75.0;
constexpr double bytes_per_row = 80.0;
constexpr double bytes_per_step = 12.0;

constexpr double gravity = 9.81;  // m/s^2

/// Returns the factor on the number of iterations due to a smaller tolerance or the slower solver.
double difficulty(const Scenario& scenario) {
  const double digits = std::log10(scenario.solver.tolerance) / std::log10(Scenario{}.solver.tolerance);
  return digits *
         (scenario.solver.method == scenario::SolverMethod::accelerated ? 1.0 : gauss_seidel_iterations);
}

/// Returns the seconds spent on commits: at each frame, and every output.checkpoint_every, but at most once
/// per step.
double seconds_of_commits(const Scenario& scenario, const Estimate& sizes, double computing) {
  const auto steps = static_cast<double>(sizes.deposition_steps + sizes.tilt_steps + sizes.flow_steps);
  const double commits = std::min(steps, computing / std::max(scenario.output.checkpoint_every, 1e-6)) +
                         static_cast<double>(sizes.frames);
  return commits * (seconds_per_commit + seconds_per_commit_and_grain * sizes.grains);
}

/// Returns the largest expected tilt, deg.
double steepest_expected(const Scenario& scenario, const scenario::TiltProgram& program) {
  if (program.empty()) return scenario.tilt.end_angle.value_or(assumed_repose);
  double steepest = program.ends_at_repose() ? assumed_repose : 0.0;
  for (const scenario::TiltSegment& segment : program.segments())
    if (!program.ends_at_repose() || &segment != &program.segments().back())
      steepest = std::max({steepest, std::abs(segment.from), std::abs(segment.to)});
  return steepest;
}

/// Returns the steps that may follow failure; a slope that is stable up to tilt.end_angle takes none of them.
double steps_of_flow(const Scenario& scenario, double end) {
  switch (scenario.tilt.after_failure) {
    case scenario::AfterFailure::lower:
      return end / scenario.tilt.lowering_rate / scenario::time_step(scenario);
    case scenario::AfterFailure::hold:
      return scenario.deposition.max_time / scenario::time_step(scenario);
    case scenario::AfterFailure::stop:
      break;
  }
  return 0.0;
}

double estimated_seconds(const Scenario& scenario, const Estimate& sizes) {
  const double factor = difficulty(scenario);
  const double most = scenario.solver.max_iterations;
  const double tilt = scenario.deposition.method == scenario::DepositionMethod::collapse
                          ? iterations_of_tilt_of_collapsed
                          : iterations_of_tilt;
  const double iterations =
      std::min(iterations_of_deposition * factor, most) * static_cast<double>(sizes.deposition_steps) +
      std::min(tilt * factor, most) * static_cast<double>(sizes.tilt_steps + sizes.flow_steps);
  const bool accelerated = scenario.solver.method == scenario::SolverMethod::accelerated;
  const double computing = (accelerated ? seconds_per_contact_and_iteration : seconds_per_contact_and_sweep) *
                           sizes.contacts * iterations;
  return computing + seconds_of_commits(scenario, sizes, computing);
}

double estimated_file(const Estimate& sizes) {
  const double grains = sizes.grains + sizes.floor_grains;
  return bytes_of_file +
         grains * (checkpoint_bytes_per_grain + frame_bytes_per_grain * static_cast<double>(sizes.frames)) +
         bytes_per_row * static_cast<double>(sizes.observable_rows) +
         bytes_per_step * static_cast<double>(sizes.deposition_steps + sizes.tilt_steps + sizes.flow_steps);
}

namespace fs = std::filesystem;

constexpr double unlimited = std::numeric_limits<double>::infinity();

double physical_memory() {
  struct sysinfo info = {};
  if (sysinfo(&info) != 0) return unlimited;
  return (static_cast<double>(info.totalram) + static_cast<double>(info.totalswap)) * info.mem_unit;
}

double shell_limit() {
  rlimit limit = {};
  const bool limited = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return limited ? static_cast<double>(limit.rlim_cur) : unlimited;
}

/// Returns the smallest limit of a group and its parents. A file without a number ("max") is no limit.
double min_limit(const fs::path& root, fs::path group, const char* file) {
  double least = unlimited;
  for (;; group = group.parent_path()) {
    double limit = 0.0;
    if (std::ifstream(root / group.relative_path() / file) >> limit) least = std::min(least, limit);
    if (!group.has_relative_path()) return least;
  }
}

/// Returns the limit of the control groups, from lines "0::/group" (version 2) and "5:memory:/group"
/// (version 1).
double cgroup_memory() {
  double least = unlimited;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string kinds = line.substr(first + 1, second - first - 1), group = line.substr(second + 1);
    if (kinds.empty()) least = std::min(least, min_limit("/sys/fs/cgroup", group, "memory.max"));
    if (kinds == "memory")
      least = std::min(least, min_limit("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
  }
  return least;
}

}  // namespace

std::int64_t expected_tilt_steps(const Scenario& scenario) {
  const scenario::TiltProgram program(scenario);
  if (program.empty())
    return std::llround(scenario.tilt.end_angle.value_or(assumed_repose) / scenario.tilt.step);
  if (!program.ends_at_repose()) return program.steps();
  const scenario::TiltSegment& last = program.segments().back();
  const double rise = std::max(0.0, assumed_repose - last.from) / last.step;
  return last.begin + std::min(last.steps, static_cast<std::int64_t>(std::llround(rise)));
}

Estimate estimate(const Scenario& scenario) {
  Estimate result;
  result.grains = grain_count(scenario);
  if (scenario.bed.floor == scenario::BedFloor::rough)
    result.floor_grains = static_cast<Index>(scenario.bed.length);
  result.contacts = static_cast<Index>(std::lround(contacts_per_grain * result.grains));
  result.time_step = scenario::time_step(scenario);

  const double depth = scenario.bed.depth * scenario.grains.mean_diameter;
  const double rest = std::min(falls_until_rest * std::sqrt(depth / gravity), scenario.deposition.max_time);
  result.deposition_steps = std::llround((end_of_arrivals(scenario) + rest) / result.time_step);
  const scenario::TiltProgram program(scenario);
  const double end = steepest_expected(scenario, program);
  result.tilt_steps = expected_tilt_steps(scenario);
  result.program_parts = static_cast<std::int64_t>(program.segments().size());
  result.flow_steps = std::llround(steps_of_flow(scenario, end));
  // Frames of the flow and of a programme have the same intervals of time as those of a growing tilt.
  const auto steps_of_tilt = static_cast<double>(result.tilt_steps);
  const double stored = (program.empty() ? end : steps_of_tilt * scenario.tilt.step) +
                        static_cast<double>(result.flow_steps) * scenario.tilt.step;
  result.frames = 1 + static_cast<std::int64_t>(stored / scenario.output.frame_every) + result.program_parts;
  result.observable_rows =
      1 + static_cast<std::int64_t>(stored / scenario.output.observable_every) + result.program_parts;

  result.seconds = estimated_seconds(scenario, result);
  result.disk = estimated_file(result);
  result.memory = bytes_of_process + memory_per_grain * (result.grains + result.floor_grains) +
                  memory_of_packing * result.disk;
  return result;
}

void require_memory(const Scenario& scenario) {
  Scenario without_flow = scenario;
  without_flow.tilt.after_failure = scenario::AfterFailure::stop;
  const Estimate expected = estimate(without_flow);
  // Memory and swap of the machine, or the smaller limit of the shell (ulimit -v) or of a control group.
  const double most = std::min({physical_memory(), shell_limit(), cgroup_memory()});
  if (expected.memory > most)
    throw Error(ExitCode::out_of_memory,
                "this run needs up to about {} of memory, but only {} are available: use a smaller bed "
                "(bed.length, bed.depth), fewer frames (output.frame_every), or a machine with more memory",
                size_text(expected.memory), size_text(most));
}

std::string size_text(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", std::ceil(bytes / 1e6))
                     : fmt::format("{:.1f} GB", bytes / 1e9);
}

std::string duration_text(double seconds) {
  const long whole = std::lround(seconds);
  if (whole >= 3600) return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
  if (whole >= 60) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} s", whole);
}

}  // namespace talus::session
