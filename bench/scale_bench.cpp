/// Cost of an iteration and peak memory of a step for a bed of a given size; prints one row of a Markdown
/// table. Each size needs a separate process, because peak memory is that of the process.

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
#include "solver/problem.h"

namespace talus::bench {
namespace {

/// Returns the wall time of one iteration (s), from a solve of `iterations` iterations.
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

/// Returns medians for one and two threads, measured alternately.
std::array<double, 2> pass_seconds(const FrozenStep& step) {
  constexpr int repetitions = 7;
  // Fewer than 512 iterations, as in most solves of a run; longer solves also average impulses.
  const int iterations = std::clamp(150'000'000 / step.problem.contact_count(), 100, 400);
  std::array<solver::SolverWorkspace, 2> workspaces;
  std::array<std::array<double, repetitions>, 2> seconds{};
  for (int k = 0; k < repetitions; ++k)
    for (std::size_t t = 0; t < 2; ++t)
      seconds[t][k] = seconds_per_iteration(step, static_cast<int>(t) + 1, iterations, workspaces[t]);
  for (auto& thread_seconds : seconds) std::ranges::sort(thread_seconds);
  return {seconds[0][repetitions / 2], seconds[1][repetitions / 2]};
}

/// Returns the named size of this process in bytes (proc(5)).
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

/// Returns the peak resident memory during steps (bytes), the world included, without that of the bare
/// program.
double peak_of_steps(World world, double bare_program) {
  std::ofstream("/proc/self/clear_refs") << 5;  // resets the peak
  dynamics::StepSettings settings = run_settings(scenario::time_step(scenario::Scenario{}));
  settings.solver.max_iterations = 10;
  dynamics::StepWorkspace workspace;
  for (int k = 0; k < 3; ++k) dynamics::step(world, settings, workspace);
  return process_bytes("VmHWM") - bare_program;
}

/// Returns the residual of the remembered forces, which is that of the tile if its copies are in equilibrium.
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
