/// Takes steps of the tilt at 10 deg on request: for each line "THREADS STEPS" of the standard input, prints
/// the seconds of the steps, their iterations, and the hash of the state after them. bench/run_pairs.py uses
/// two such programs alternately.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <iostream>

#include "beds.h"
#include "core/trigonometry.h"
#include "core/world.h"
#include "frozen_step.h"
#include "program.h"
#include "session/session.h"

namespace talus::bench {
namespace {

void answer(World& world, int threads, int steps, dynamics::StepWorkspace& workspace) {
  dynamics::StepSettings settings = run_settings(scenario::time_step(scenario::Scenario{}));
  settings.solver.threads = threads;
  long iterations = 0;
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < steps; ++k) {
    iterations += dynamics::step(world, settings, workspace).solver.iterations;
    world.tilt += radians(scenario::Scenario{}.tilt.step);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("%.6e %ld %016llx\n", seconds, iterations, static_cast<unsigned long long>(state_hash(world)));
  std::fflush(stdout);
}

int run(int argc, char** argv) {
  Index grains = 0;
  CLI::App app("Steps of the tilt at 10 deg, requested on the standard input");
  app.add_option("grains", grains, "500, 2000 or a multiple of 4000")->required();
  CLI11_PARSE(app, argc, argv)
  World world = bed(grains, Slope::ten_degrees, scenario::time_step(scenario::Scenario{}));
  dynamics::StepWorkspace workspace;
  for (int threads = 0, steps = 0; std::cin >> threads >> steps;) answer(world, threads, steps, workspace);
  return 0;
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) {
  return talus::bench::run_program("steps_bench", talus::bench::run, argc, argv);
}
