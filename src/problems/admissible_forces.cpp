#include "problems/admissible_forces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/frame_analysis.h"
#include "base/errors.h"
#include "core/statistics.h"
#include "runs/analysis_input.h"
#include "runs/analysis_parameters.h"
#include "runs/analysis_run.h"
#include "session/measure.h"
#include "solver/balance.h"

namespace talus::problems {
namespace {

/// Returns a number exponentially distributed with mean 1, by comparisons of uniform numbers (von Neumann
/// 1951). Unlike a library's logarithm, this gives the same bits on every platform.
double exponential(Random& random) {
  for (double whole = 0.0;; whole += 1.0) {
    const double first = random.uniform();
    bool odd = true;  // whether the length of the descending run is odd
    double last = first;
    for (double next = random.uniform(); next < last; next = random.uniform()) {
      last = next;
      odd = !odd;
    }
    if (odd) return whole + first;
  }
}

/// Returns the factor by which a start multiplies the remembered force of a contact.
double factor_of_memory(ForceStart start, Random& random) {
  switch (start) {
    case ForceStart::stored:
      return 1.0;
    case ForceStart::halved:
      return 0.5;
    case ForceStart::doubled:
      return 2.0;
    case ForceStart::scattered:
      return 2.0 * random.uniform();
    default:
      return 0.0;
  }
}

double mean_normal_impulse(const solver::ContactSolution& solution) {
  double sum = 0.0;
  int carrying = 0;
  for (const double pn : solution.pn)
    if (pn > 0.0) {
      sum += pn;
      ++carrying;
    }
  return carrying > 0 ? sum / carrying : 0.0;
}

/// Returns the problem with its contacts in another order: contact c of the result is contact order[c].
solver::ContactProblem reordered(const solver::ContactProblem& problem,
                                 const std::vector<std::size_t>& order) {
  solver::ContactProblem result = problem;
  const auto take = [&order](const auto& from, auto& to) {
    for (std::size_t c = 0; c < order.size(); ++c) to[c] = from[order[c]];
  };
  take(problem.a, result.a);
  take(problem.b, result.b);
  for (auto field : {&solver::ContactProblem::nx, &solver::ContactProblem::ny, &solver::ContactProblem::cn,
                     &solver::ContactProblem::ct, &solver::ContactProblem::mu})
    take(problem.*field, result.*field);
  return result;
}

std::vector<std::size_t> random_order(std::size_t count, Random& random) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t c = count; c > 1; --c)
    std::swap(order[c - 1], order[random.below(static_cast<std::uint32_t>(c))]);
  return order;
}

solver::SolverReport solve_shuffled(const solver::ContactProblem& problem,
                                    const solver::SolverSettings& settings, Random& random,
                                    solver::SolverWorkspace& workspace, solver::ContactSolution& solution) {
  const std::vector<std::size_t> order = random_order(solution.pn.size(), random);
  solver::ContactSolution shuffled = solution;
  for (std::size_t c = 0; c < order.size(); ++c) {
    shuffled.pn[c] = solution.pn[order[c]];
    shuffled.pt[c] = solution.pt[order[c]];
  }
  const solver::SolverReport report = solver::solve(reordered(problem, order), settings, workspace, shuffled);
  solution.vx = shuffled.vx;
  solution.vy = shuffled.vy;
  solution.omega = shuffled.omega;
  for (std::size_t c = 0; c < order.size(); ++c) {
    solution.pn[order[c]] = shuffled.pn[c];
    solution.pt[order[c]] = shuffled.pt[c];
  }
  return report;
}

solver::SolverReport continue_search(const solver::ContactProblem& problem, ForceMethod method,
                                     const ForceSearch& search, Random& random,
                                     solver::ContactSolution& solution) {
  if (method == ForceMethod::balance)
    return solver::balance(problem, search.tolerance, search.max_iterations, solution);
  solver::SolverSettings settings;
  settings.tolerance = search.tolerance;
  settings.max_iterations = search.max_iterations;
  solver::SolverWorkspace workspace;
  if (method == ForceMethod::contact_dynamics) return solver::solve(problem, settings, workspace, solution);
  settings.kind = solver::SolverKind::gauss_seidel;
  return solve_shuffled(problem, settings, random, workspace, solution);
}

/// Returns the number of free grains with a velocity above `limit`, m/s.
Index count_faster(const solver::ContactSolution& solution, Index free_count, double limit) {
  Index count = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(free_count); ++i) {
    const double vx = solution.vx[i], vy = solution.vy[i];
    if (vx * vx + vy * vy > limit * limit) ++count;
  }
  return count;
}

double relative_distance(const solver::ContactSolution& one, const solver::ContactSolution& reference) {
  double difference = 0.0, scale = 0.0;
  for (std::size_t c = 0; c < one.pn.size(); ++c) {
    const double dn = one.pn[c] - reference.pn[c], dt = one.pt[c] - reference.pt[c];
    difference += dn * dn + dt * dt;
    scale += reference.pn[c] * reference.pn[c] + reference.pt[c] * reference.pt[c];
  }
  return std::sqrt(difference / scale);
}

std::vector<ForceQuantity> quantities_of(const analysis::AnalysisParameters& parameters) {
  std::vector<ForceQuantity> quantities = {{"Gamma"}, {"critical_share"}};
  for (const double factor : parameters.threshold_factors)
    for (const char* name : {"p_o", "lc_mean", "lc_max"}) quantities.push_back({name, factor});
  return quantities;
}

/// Measures the quantities of frames.
class Measurement {
 public:
  Measurement(const RunStatics& statics, const analysis::AnalysisParameters& parameters, double theta_c)
      : statics_(statics),
        parameters_(parameters),
        analysis_(analysis::begin_analysis(statics, parameters, theta_c)) {
    if (parameters.averaging > 0.0)
      throw Error(ExitCode::bad_data, "the forces of one frame cannot be averaged over frames");
    if (analysis_.thresholds.empty())
      throw Error(ExitCode::bad_data,
                  "the slope has not failed, so Gamma_c is not known; give it with --set gamma_c=0.3");
  }

  /// Returns the values of a frame in the order of quantities_of.
  std::vector<double> values(Frame frame) const {
    const analysis::FrameRecord record = analysis::analyse_frame(
        {analysis::with_analysed_gamma(std::move(frame), statics_, parameters_), statics_}, parameters_,
        analysis_);
    std::vector<double> found = {record.stress_ratio, record.critical_share};
    for (const analysis::FrameThreshold& at : record.thresholds)
      found.insert(found.end(), {at.overloaded_fraction, at.lc_mean / statics_.mean_diameter,
                                 at.lc_max / statics_.mean_diameter});
    return found;
  }

 private:
  const RunStatics& statics_;
  const analysis::AnalysisParameters& parameters_;
  analysis::Analysis analysis_;  ///< thresholds and cut of l_c, without frames
};

ForceSpread spread_of(std::size_t quantity, const std::vector<ForceSet>& sets) {
  std::vector<double> values;
  for (std::size_t s = 1; s < sets.size(); ++s)
    if (sets[s].admissible() && !std::isnan(sets[s].values[quantity]))
      values.push_back(sets[s].values[quantity]);
  const Statistics found = statistics_of(values);
  ForceSpread spread{found.count, found.mean, found.error * std::sqrt(static_cast<double>(found.count)),
                     not_known, not_known};
  if (values.empty()) return spread;
  const auto [least, largest] = std::ranges::minmax(values);
  spread.least = least;
  spread.largest = largest;
  return spread;
}

}  // namespace

std::string name_of(const ForceAttempt& attempt) {
  const char* const starts[] = {"stored", "zero", "halved", "doubled", "scattered", "exponential", "uniform"};
  const char* const methods[] = {"", ", contact dynamics", ", shuffled sweeps"};
  return std::string(starts[static_cast<std::size_t>(attempt.start)]) +
         methods[static_cast<std::size_t>(attempt.method)];
}

std::vector<ForceAttempt> force_attempts(const ForceSearch& search) {
  constexpr ForceStart random_starts[] = {ForceStart::scattered, ForceStart::exponential,
                                          ForceStart::uniform};
  std::vector<ForceAttempt> attempts = {{ForceStart::stored, ForceMethod::contact_dynamics},
                                        {ForceStart::zero},
                                        {ForceStart::halved},
                                        {ForceStart::doubled},
                                        {ForceStart::zero, ForceMethod::contact_dynamics},
                                        {ForceStart::zero, ForceMethod::shuffled_sweeps}};
  const auto count = static_cast<std::size_t>(search.solutions) + 1;
  while (attempts.size() < count) attempts.push_back({random_starts[attempts.size() % 3]});
  attempts.resize(count);
  return attempts;
}

solver::ContactSolution first_guess(ForceStart start, const FrozenBed& bed, Random& random) {
  solver::ContactSolution guess = bed.step.guess;
  const solver::ContactProblem& problem = bed.step.problem;
  const bool from_memory = start != ForceStart::exponential && start != ForceStart::uniform;
  const double mean = from_memory ? 0.0 : mean_normal_impulse(guess) * random.uniform(0.0, 2.0);
  for (std::size_t c = 0; c < guess.pn.size(); ++c) {
    if (from_memory) {
      const double factor = factor_of_memory(start, random);
      guess.pn[c] *= factor;
      guess.pt[c] *= factor;
      continue;
    }
    const bool closed = problem.cn[c] <= 0.0;
    const double share = start == ForceStart::exponential ? exponential(random) : 2.0 * random.uniform();
    guess.pn[c] = closed ? mean * share : 0.0;
    guess.pt[c] = problem.mu[c] * guess.pn[c] * random.uniform(-1.0, 1.0);
  }
  return guess;
}

ForceSet find_forces(const FrozenBed& bed, const ForceAttempt& attempt, const ForceSearch& search,
                     Random& random) {
  ForceSet found;
  found.attempt = attempt;
  found.solution = first_guess(attempt.start, bed, random);
  found.report = continue_search(bed.step.problem, attempt.method, search, random, found.solution);
  const double fall = bed.step.scales.gravity * bed.step.scales.h;
  found.momentum_left = rms_velocity(loaded_world(bed, found.solution).grains) / fall;
  found.unbalanced = count_faster(found.solution, bed.world.grains.free_count, 0.1 * fall);
  found.distance = relative_distance(found.solution, bed.step.guess);
  return found;
}

World loaded_world(const FrozenBed& bed, const solver::ContactSolution& solution) {
  World world = bed.world;
  const Index free = world.grains.free_count;
  std::copy_n(solution.vx.begin(), free, world.grains.vx.begin());
  std::copy_n(solution.vy.begin(), free, world.grains.vy.begin());
  std::copy_n(solution.omega.begin(), free, world.grains.omega.begin());
  for (std::size_t c = 0; c < solution.pn.size(); ++c) {
    world.contacts.fn[c] = solution.pn[c] / bed.step.scales.h;
    world.contacts.ft[c] = solution.pt[c] / bed.step.scales.h;
  }
  return world;
}

int FrameForces::admissible() const {
  return static_cast<int>(
      std::count_if(sets.begin() + 1, sets.end(), [](const ForceSet& set) { return set.admissible(); }));
}

FrameForces admissible_forces(const FrozenBed& bed, const BedFrame& stored,
                              const analysis::AnalysisParameters& parameters, double theta_c,
                              const ForceSearch& search) {
  const Measurement measurement(stored.statics, parameters, theta_c);
  FrameForces found;
  found.tilt = bed.step.scales.tilt;
  found.contacts = bed.step.problem.contact_count();
  found.quantities = quantities_of(parameters);
  found.stored = measurement.values(stored.frame);
  Random random(search.seed);
  for (const ForceAttempt& attempt : force_attempts(search)) {
    ForceSet set = find_forces(bed, attempt, search, random);
    set.values = measurement.values(session::make_frame(loaded_world(bed, set.solution), bed.law));
    found.sets.push_back(std::move(set));
  }
  for (std::size_t q = 0; q < found.quantities.size(); ++q) found.spreads.push_back(spread_of(q, found.sets));
  return found;
}

FrameForces admissible_forces(const io::RunFile& run, std::size_t k,
                              const analysis::AnalysisParameters& parameters, const ForceSearch& search) {
  const double theta_c = find_value(run.checkpoint().results, "theta_c").value_or(not_known);
  return admissible_forces(frozen_frame(run, k), {run.frame(k), run.header().statics}, parameters, theta_c,
                           search);
}

}  // namespace talus::problems
