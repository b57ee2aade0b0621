/// Talus and Siconos on the same contact problems, from the same guess to the same error, by Siconos's
/// measure; alternately on one core in one process. Seconds are processor time. Prints one row of a Markdown
/// table for each problem.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "beds.h"
#include "frozen_step.h"
#include "processor_time.h"
#include "program.h"
#include "scenario/scenario.h"
#include "siconos_peer.h"
#include "solver/local_problem.h"
#include "solver/problem.h"
#include "solver/solve.h"

namespace talus::bench {
namespace {

struct Limits {
  double seconds = 60.0;  ///< longest Siconos solve
  int sweeps = 20000;
  int repetitions = 5;
};

struct Case {
  Slope slope;
  bool warm;
  double tolerance;
};
constexpr Case cases[] = {
    {Slope::flat, false, 1e-3},
    {Slope::flat, false, 1e-4},
    {Slope::ten_degrees, true, 1e-4},
    {Slope::ten_degrees, true, 1e-6},
};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

solver::ContactSolution with_impulses(const solver::ContactProblem& problem,
                                      const std::vector<solver::Impulse>& p) {
  solver::ContactSolution solution;
  for (const solver::Impulse& impulse : p) {
    solution.pn.push_back(impulse.normal);
    solution.pt.push_back(impulse.tangential);
  }
  solver::velocities_from_impulses(problem, solution);
  return solution;
}

std::vector<solver::Impulse> impulses(const solver::ContactSolution& solution) {
  std::vector<solver::Impulse> p;
  for (std::size_t c = 0; c < solution.pn.size(); ++c) p.push_back({solution.pn[c], solution.pt[c]});
  return p;
}

/// One problem in the forms of both solvers.
struct Match {
  FrozenStep step;
  solver::LocalProblem local;
  SiconosProblem siconos;
  solver::SolverWorkspace workspace;

  explicit Match(FrozenStep frozen)
      : step(std::move(frozen)), local(local_problem(step.problem)), siconos(local, Storage::sparse_blocks) {}
};

struct TalusRun {
  solver::SolverReport report;
  solver::ContactSolution solution;
  double seconds = 0.0;
};

TalusRun run_talus(Match& match, double eta) {
  solver::SolverSettings settings;
  settings.tolerance = eta;
  settings.max_iterations = 200000;
  TalusRun run{{}, match.step.guess};
  const double start = processor_seconds();
  run.report = solve(match.step.problem, settings, match.workspace, run.solution);
  run.seconds = processor_seconds() - start;
  return run;
}

/// Returns the loosest eta of a fine geometric series at which the solution of Talus has the required error,
/// or 0 if none has. The two measures are similar but not proportional, hence the search, which is not timed.
double eta_for_error(Match& match, double error) {
  constexpr double loosest = 0.1;
  constexpr double factor = 0.8;
  for (double eta = loosest; eta > 1e-14; eta *= factor) {
    const TalusRun run = run_talus(match, eta);
    if (match.siconos.error(impulses(run.solution)) <= error) return eta;
    if (!run.report.converged) return 0.0;
  }
  return 0.0;
}

struct SiconosRun {
  SiconosReport report;
  std::vector<solver::Impulse> p;
};

SiconosRun run_siconos(Match& match, double error, int max_sweeps) {
  SiconosRun run{{}, impulses(match.step.guess)};
  run.report = match.siconos.solve(SiconosSolver::nsgs, error, max_sweeps, run.p);
  return run;
}

/// Returns the number of sweeps that Siconos can make within the limits.
int affordable_sweeps(Match& match, const Limits& limits) {
  constexpr int few = 10;
  const double seconds_of_few = run_siconos(match, 0.0, few).report.seconds;
  return static_cast<int>(std::min<double>(limits.sweeps, limits.seconds / seconds_of_few * few));
}

/// Returns sqrt of the mean of |v1 - v2|^2 over free bodies; rotation counts with its rim velocity.
double rms_difference(const solver::ContactProblem& problem, const solver::ContactSolution& one,
                      const solver::ContactSolution& two) {
  double sum = 0.0;
  int count = 0;
  for (Index i = 0; i < problem.body_count(); ++i) {
    if (problem.inverse_mass[i] == 0.0) continue;
    const double x = one.vx[i] - two.vx[i];
    const double y = one.vy[i] - two.vy[i];
    const double rim = problem.lever[i] * (one.omega[i] - two.omega[i]);
    sum += x * x + y * y + rim * rim;
    ++count;
  }
  return std::sqrt(sum / count);
}

double norm(const std::vector<double>& n, const std::vector<double>& t) {
  double sum = 0.0;
  for (std::size_t c = 0; c < n.size(); ++c) sum += n[c] * n[c] + t[c] * t[c];
  return std::sqrt(sum);
}

double relative_impulse_difference(const solver::ContactSolution& one, const solver::ContactSolution& two) {
  std::vector<double> n = one.pn;
  std::vector<double> t = one.pt;
  for (std::size_t c = 0; c < n.size(); ++c) {
    n[c] -= two.pn[c];
    t[c] -= two.pt[c];
  }
  return norm(n, t) / norm(two.pn, two.pt);
}

/// Returns || U1 - U2 || over the norm to which Siconos's error is relative.
double relative_velocity_difference(const Match& match, const solver::ContactSolution& one,
                                    const solver::ContactSolution& two) {
  const std::vector<solver::RelativeVelocity> u1 = local_form(match.step.problem, one).u;
  const solver::LocalSolution other = local_form(match.step.problem, two);
  double difference = 0.0;
  double impulse = 0.0;
  double velocity = 0.0;
  double free_velocity = 0.0;
  const auto add_square = [](double& sum, double n, double t) { sum += n * n + t * t; };
  for (std::size_t c = 0; c < u1.size(); ++c) {
    const solver::RelativeVelocity& u2 = other.u[c];
    add_square(difference, u1[c].normal - u2.normal, u1[c].tangential - u2.tangential);
    add_square(impulse, other.p[c].normal, other.p[c].tangential);
    add_square(velocity, u2.normal, u2.tangential);
    add_square(free_velocity, match.local.q[c].normal, match.local.q[c].tangential);
  }
  return std::sqrt(difference / std::max({impulse, velocity, free_velocity}));
}

struct Timing {
  SiconosRun siconos;
  TalusRun talus;
  std::vector<double> siconos_seconds, talus_seconds;  ///< time of each solve
};

/// Times both solvers alternately, so that other load affects both. A solve of more than ten seconds is not
/// repeated.
Timing time_both(Match& match, double error, double eta, const Limits& limits) {
  constexpr double too_long_to_repeat = 10.0;
  const int max_sweeps = affordable_sweeps(match, limits);
  Timing timing;
  for (int k = 0; k < limits.repetitions; ++k) {
    if (k == 0 || timing.siconos_seconds.front() < too_long_to_repeat) {
      timing.siconos = run_siconos(match, error, max_sweeps);
      timing.siconos_seconds.push_back(timing.siconos.report.seconds);
    }
    if (k == 0 || timing.talus_seconds.front() < too_long_to_repeat) {
      timing.talus = run_talus(match, eta);
      timing.talus_seconds.push_back(timing.talus.seconds);
    }
  }
  return timing;
}

void print_solve(double seconds, std::size_t repetitions, int iterations, bool fails) {
  std::printf("%s%.4g (%zu) | %d | ", fails ? "fails: " : "", seconds, repetitions, iterations);
}

/// Prints the ratio: a lower bound if Siconos fails, none if Talus fails.
void print_ratio(double ratio, bool siconos_fails, bool talus_fails) {
  if (talus_fails)
    std::printf("- |");
  else
    std::printf("%s%.*f |", siconos_fails ? "> " : "", ratio < 10.0 ? 1 : 0, ratio);
}

void print_row(Match& match, Index grains, const Case& setting, const Timing& timing) {
  const solver::ContactProblem& problem = match.step.problem;
  const solver::ContactSolution theirs = with_impulses(problem, timing.siconos.p);
  const solver::ContactSolution& ours = timing.talus.solution;
  const double their_error = match.siconos.error(timing.siconos.p);
  const double our_error = match.siconos.error(impulses(ours));
  const bool siconos_fails = their_error > setting.tolerance;
  const bool talus_fails = our_error > setting.tolerance;
  const double their_seconds = median(timing.siconos_seconds);
  const double our_seconds = median(timing.talus_seconds);
  std::printf("| %d | %d | %s | %.0e | ", grains, problem.contact_count(),
              setting.warm ? "10 deg, warm" : "flat, cold", setting.tolerance);
  print_solve(their_seconds, timing.siconos_seconds.size(), timing.siconos.report.iterations, siconos_fails);
  print_solve(our_seconds, timing.talus_seconds.size(), timing.talus.report.iterations, talus_fails);
  print_ratio(their_seconds / our_seconds, siconos_fails, talus_fails);
  std::printf(" %.2e | %.2e | %.2e | %.2e |", their_error, our_error,
              solver::natural_map_residual(problem, theirs).eta, timing.talus.report.residual.eta);
  std::printf(" %.1e | %.1e | %.1e |\n", relative_velocity_difference(match, ours, theirs),
              rms_difference(problem, ours, theirs) / match.step.gravity_step,
              relative_impulse_difference(ours, theirs));
  std::fflush(stdout);
}

void print_header() {
  std::printf(
      "| grains | contacts | problem | error | Siconos, s (solves) | sweeps | Talus, s (solves) | iterations "
      "| "
      "ratio | "
      "error of Siconos | error of Talus | eta of Siconos | eta of Talus | U differs | v differs, g h | P "
      "differ |\n|--:|--:|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
}

void run_case(Index grains, const Case& setting, bool si, const Limits& limits) {
  constexpr double dt = 5e-3;
  const double h = si ? scenario::time_step(scenario::Scenario{}) : seconds_of(dt);
  const World world = bed(grains, setting.slope, h);
  FrozenStep step =
      si ? next_step(world, h, Candidates::close) : dimensionless_next_step(world, dt, Candidates::close);
  if (!setting.warm) step.guess = cold_guess(step.problem);
  Match match(std::move(step));
  const double eta = eta_for_error(match, setting.tolerance);
  print_row(match, grains, setting, time_both(match, setting.tolerance, eta, limits));
}

int run(int argc, char** argv) {
  Limits limits;
  std::vector<Index> sizes{500, 2000, 4000, 8000, 20000, 40000, 100000};
  bool si = false;
  CLI::App app("Talus against Siconos's 2D nonsmooth Gauss-Seidel on sparse blocks");
  app.add_option("--grains", sizes, "Sizes of the beds")->capture_default_str();
  app.add_flag("--si", si,
               "SI units and the step of the paper's run, instead of D = m = g = 1 and dt = 5e-3");
  app.add_option("--seconds", limits.seconds, "Longest Siconos solve")->capture_default_str();
  app.add_option("--sweeps", limits.sweeps, "Maximum number of sweeps of a Siconos solve")
      ->capture_default_str();
  app.add_option("--repetitions", limits.repetitions, "Number of solves, of which medians are printed")
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv)
  print_header();
  for (const Index grains : sizes)
    for (const Case& setting : cases) run_case(grains, setting, si, limits);
  return 0;
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) {
  return talus::bench::run_program("siconos_bench", talus::bench::run, argc, argv);
}
