/// Cost of an iteration and peak memory of a step for a bed of a given size; one row of a Markdown table. One
/// process for each size, so that memory is that of this size alone.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>

#include "base/errors.h"
#include "beds.h"
#include "frozen_step.h"
#include "program.h"
#include "session/session.h"
#include "solver/residual.h"

namespace talus::bench {
namespace {

/// Wall seconds of one iteration, from a solve of `iterations` of them.
double seconds_per_iteration(const FrozenStep& step, int threads, int iterations,
                             solver::SolverWorkspace& workspace) {
  solver::SolverSettings settings;
  settings.tolerance = 0.0;
  settings.max_iterations = iterations;
  settings.threads = threads;
  workspace.accelerated.choice = {};  // all threads, even on a busy machine
  solver::ContactSolution solution = cold_guess(step.problem);
  const auto start = std::chrono::steady_clock::now();
  solver::solve(step.problem, settings, workspace, solution);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / iterations;
}

/// Medians for one and two threads, measured in turn.
std::array<double, 2> pass_seconds(const FrozenStep& step) {
  constexpr int repetitions = 7;
  // As in a run: a solve of more than 512 iterations, which looks for the mean of iterates, is rare.
  const int iterations = std::clamp(150'000'000 / step.problem.contact_count(), 100, 400);
  std::array<solver::SolverWorkspace, 2> workspaces;
  std::array<std::array<double, repetitions>, 2> seconds{};
  for (int k = 0; k < repetitions; ++k)
    for (std::size_t t = 0; t < 2; ++t)
      seconds[t][k] = seconds_per_iteration(step, static_cast<int>(t) + 1, iterations, workspaces[t]);
  for (auto& of_threads : seconds) std::ranges::sort(of_threads);
  return {seconds[0][repetitions / 2], seconds[1][repetitions / 2]};
}

/// The named size of this process in bytes (proc(5)).
double process_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == name + ":") {
      double kilobytes = 0.0;
      status >> kilobytes;
      return 1024.0 * kilobytes;
    }
  throw Error(ExitCode::unavailable, "/proc/self/status has no " + name);
}

/// Peak resident memory while steps are taken, the world included, beyond that of the bare program, bytes.
double peak_of_steps(World world, double bare_program) {
  std::ofstream("/proc/self/clear_refs") << 5;  // the peak is counted from here on
  dynamics::StepSettings settings = run_settings(scenario::time_step(scenario::Scenario{}));
  settings.solver.max_iterations = 10;
  dynamics::StepWorkspace workspace;
  for (int k = 0; k < 3; ++k) dynamics::step(world, settings, workspace);
  return process_bytes("VmHWM") - bare_program;
}

/// Residual of the remembered forces: that of the tile, where copies of it stand in equilibrium as it does.
double eta_of_guess(FrozenStep step) {
  solver::velocities_from_impulses(step.problem, step.guess);
  return solver::natural_map_residual(step.problem, step.guess).eta;
}

void print_row(Index grains) {
  const double bare_program = process_bytes("VmRSS");
  const double peak =
      peak_of_steps(bed(grains, Slope::flat, scenario::time_step(scenario::Scenario{})), bare_program);
  const FrozenStep step = next_step(bed(grains, Slope::flat, scenario::time_step(scenario::Scenario{})),
                                    scenario::time_step(scenario::Scenario{}));
  const double contacts = step.problem.contact_count();
  const std::array<double, 2> seconds = pass_seconds(step);
  std::printf("| %d | %.0f | %.2f | %.2f | %.2f | %.2f | %.0f | %.3e |\n", grains, contacts,
              1e9 * seconds[0] / contacts, 1e9 * seconds[1] / contacts, 1e9 * seconds[0] / grains,
              1e9 * seconds[1] / grains, peak / grains, eta_of_guess(step));
}

int run(int argc, char** argv) {
  Index grains = 0;
  CLI::App app("Cost per grain and iteration, and memory per grain");
  app.add_option("grains", grains, "500, 2000 or a multiple of 4000")->required();
  CLI11_PARSE(app, argc, argv)
  print_row(grains);
  return 0;
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) {
  return talus::bench::run_program("scale_bench", talus::bench::run, argc, argv);
}
