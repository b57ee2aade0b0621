/// Times of the solvers on the contact problem of the paper's bed, and of the stages of its steps.

#include <benchmark/benchmark.h>

#include "beds.h"
#include "core/trigonometry.h"
#include "frozen_step.h"
#include "session/session.h"
#include "solver/solve.h"

namespace talus::bench {
namespace {

constexpr Index paper_grains = 8000;
const double run_step = scenario::time_step(scenario::Scenario{});

FrozenStep flat_step() { return next_step(bed(paper_grains, Slope::flat, run_step), run_step); }
FrozenStep tilting_step() { return next_step(bed(paper_grains, Slope::ten_degrees, run_step), run_step); }

/// Returns the wall time per contact and iteration, printed with an SI prefix: 3n is 3 ns.
benchmark::Counter time_per_contact_and_iteration(const solver::ContactProblem& problem, int iterations) {
  return {static_cast<double>(problem.contact_count()) * iterations,
          benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

/// Runs a fixed number of iterations from zero impulses, on range(0) threads.
void accelerated_passes(benchmark::State& state) {
  const FrozenStep step = flat_step();
  solver::SolverSettings settings;
  settings.tolerance = 0.0;
  settings.max_iterations = 500;
  settings.threads = static_cast<int>(state.range(0));
  solver::SolverWorkspace workspace;
  solver::ContactSolution solution = cold_guess(step.problem);
  for (auto _ : state) {
    solution = cold_guess(step.problem);
    workspace.accelerated.choice = {};  // all threads, even on a busy machine
    solver::solve(step.problem, settings, workspace, solution);
  }
  state.counters["contact_iteration"] = time_per_contact_and_iteration(step.problem, settings.max_iterations);
}
BENCHMARK(accelerated_passes)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

void gauss_seidel_sweeps(benchmark::State& state) {
  const FrozenStep step = flat_step();
  solver::ContactSolution solution = cold_guess(step.problem);
  solver::velocities_from_impulses(step.problem, solution);
  for (auto _ : state) solver::gauss_seidel_sweep(step.problem, solution);
  state.counters["contact_iteration"] = time_per_contact_and_iteration(step.problem, 1);
}
BENCHMARK(gauss_seidel_sweeps)->Unit(benchmark::kMillisecond);

void solve_to(benchmark::State& state, const FrozenStep& step, double tolerance) {
  solver::SolverSettings settings;
  settings.tolerance = tolerance;
  settings.max_iterations = 100000;
  settings.threads = static_cast<int>(state.range(0));
  solver::SolverWorkspace workspace;
  solver::ContactSolution solution;
  solver::SolverReport report;
  for (auto _ : state) {
    solution = step.guess;
    workspace.accelerated.choice = {};
    report = solver::solve(step.problem, settings, workspace, solution);
  }
  if (!report.converged) state.SkipWithError("did not converge");
  state.counters["solver_iterations"] = report.iterations;
  state.counters["contact_iteration"] = time_per_contact_and_iteration(step.problem, report.iterations);
}

void cold_to_1e4(benchmark::State& state) {
  FrozenStep step = flat_step();
  step.guess = cold_guess(step.problem);
  solve_to(state, step, 1e-4);
}
BENCHMARK(cold_to_1e4)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

void warm_to_1e6(benchmark::State& state) { solve_to(state, tilting_step(), 1e-6); }
BENCHMARK(warm_to_1e6)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);

/// Takes steps of the bed at 10 deg as in a run at rest; reports the mean wall time of each stage in ms.
void steps_at_ten_degrees(benchmark::State& state) {
  World world = bed(paper_grains, Slope::ten_degrees, run_step);
  dynamics::StepSettings settings = run_settings(run_step);
  settings.solver.threads = static_cast<int>(state.range(0));
  dynamics::StepWorkspace workspace;
  std::array<double, dynamics::stage_count> seconds{};
  double iterations = 0.0;
  for (auto _ : state) {
    const dynamics::StepReport report = dynamics::step(world, settings, workspace);
    world.tilt += radians(scenario::Scenario{}.tilt.step);
    iterations += report.solver.iterations;
    for (std::size_t k = 0; k < dynamics::stage_count; ++k) seconds[k] += report.seconds[k];
  }
  const auto steps = static_cast<double>(state.iterations());
  for (std::size_t k = 0; k < dynamics::stage_count; ++k)
    state.counters[std::string(dynamics::stage_names[k]) + "_ms"] = 1e3 * seconds[k] / steps;
  state.counters["solver_iterations"] = iterations / steps;
  state.counters["contacts"] = world.contacts.count();
}
BENCHMARK(steps_at_ten_degrees)
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2)
    ->Iterations(200)
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace talus::bench
