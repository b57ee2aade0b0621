#include "dynamics/step.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "base/errors.h"
#include "contact/detection.h"

namespace talus::dynamics {
namespace {

/// Adds the wall time between its calls to the stages of a step.
class StageClock {
 public:
  explicit StageClock(StageSeconds& seconds) : seconds_(seconds), last_(Clock::now()) {}

  void end_of(Stage stage) {
    const Clock::time_point now = Clock::now();
    seconds_[static_cast<std::size_t>(stage)] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  StageSeconds& seconds_;
  Clock::time_point last_;
};

void advance(std::vector<double>& position, const std::vector<double>& velocity, double duration,
             std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) position[i] += duration * velocity[i];
}

/// Whether all x are in [0, length), which is true in nearly every step.
bool are_wrapped(const Grains& grains, double length, std::size_t first, std::size_t last) {
  std::int64_t within = 0;  // as wide as a double, so that the comparisons vectorise
  for (std::size_t i = first; i < last; ++i)
    within += static_cast<std::int64_t>(grains.x[i] >= 0.0) & static_cast<std::int64_t>(grains.x[i] < length);
  return within == static_cast<std::int64_t>(last - first);
}

/// Wraps x into [0, length).
void wrap(Grains& grains, double length) {
  for (Index i = 0; i < grains.free_count; ++i) {
    while (grains.x[i] < 0.0) {
      grains.x[i] += length;
      --grains.image[i];
    }
    while (grains.x[i] >= length) {
      grains.x[i] -= length;
      ++grains.image[i];
    }
  }
}

/// Moves some free grains along their present velocities, (T2) and (T17). Returns whether all x are still in
/// [0, length) of a periodic bed.
bool advance_positions(Grains& grains, const Boundary& boundary, double duration, std::size_t first,
                       std::size_t last) {
  advance(grains.x, grains.vx, duration, first, last);
  advance(grains.y, grains.vy, duration, first, last);
  advance(grains.angle, grains.omega, duration, first, last);
  return !boundary.periodic || are_wrapped(grains, boundary.length, first, last);
}

/// Updates the shifts of contacts, by which b touches a from x_b + shift L, for grains that have passed the
/// periodic edge since `image` was recorded.
void follow_images(const Grains& grains, const std::vector<Index>& image, Contacts& contacts) {
  const auto passed = [&grains, &image](Index i) { return grains.image[i] - image[i]; };
  for (Index c = 0; c < contacts.count(); ++c)
    if (contacts.b[c] < grains.count())  // a plane has no images
      contacts.shift[c] =
          static_cast<std::int8_t>(contacts.shift[c] + passed(contacts.b[c]) - passed(contacts.a[c]));
}

/// Copies the positions of some free grains; the others never move.
void copy_positions(const Grains& from, std::size_t first, std::size_t last, Grains& to) {
  const auto copy = [first, last](const auto& values, auto& copies) {
    std::copy(values.data() + first, values.data() + last, copies.data() + first);
  };
  copy(from.x, to.x);
  copy(from.y, to.y);
  copy(from.angle, to.angle);
  copy(from.image, to.image);
}

std::size_t free_grains(const World& world) { return world.grains.free_count; }

/// Moves the grains to the midpoint (T2) and stores their positions in `before`.
void begin_motion(World& world, double h, ThreadTeam* team, Grains& before) {
  const std::size_t count = free_grains(world);
  for (auto* field : {&before.x, &before.y, &before.angle}) field->resize(count);
  before.image.resize(count);
  std::atomic<bool> within = true;
  distribute(team, count, [&](std::size_t first, std::size_t last) {
    copy_positions(world.grains, first, last, before);
    if (!advance_positions(world.grains, world.boundary, 0.5 * h, first, last)) within = false;
  });
  if (!within) wrap(world.grains, world.boundary.length);
}

/// Moves the grains from the midpoint to the end of the step (T17), along the velocities of the solution.
/// `image` is working memory.
void end_motion(const solver::ContactSolution& solution, World& world, double h, ThreadTeam* team,
                std::vector<Index>& image) {
  Grains& grains = world.grains;
  std::atomic<bool> within = true;
  distribute(team, free_grains(world), [&](std::size_t first, std::size_t last) {
    std::copy(solution.vx.data() + first, solution.vx.data() + last, grains.vx.data() + first);  // (T6)
    std::copy(solution.vy.data() + first, solution.vy.data() + last, grains.vy.data() + first);
    std::copy(solution.omega.data() + first, solution.omega.data() + last, grains.omega.data() + first);
    if (!advance_positions(grains, world.boundary, 0.5 * h, first, last)) within = false;
  });
  if (within) return;
  image = grains.image;
  wrap(grains, world.boundary.length);
  follow_images(grains, image, world.contacts);
}

/// Returns the largest of some values, at least 0, in four strands, because a single one would wait for each
/// comparison.
template <typename Value>
double largest(std::size_t first, std::size_t last, const Value& value) {
  std::array<double, 4> strand{};
  std::size_t i = first;
  for (; i + 4 <= last; i += 4)
    for (std::size_t k = 0; k < 4; ++k) strand[k] = std::max(strand[k], value(i + k));
  for (; i < last; ++i) strand[0] = std::max(strand[0], value(i));
  return *std::max_element(strand.begin(), strand.end());
}

template <typename Value>
double largest(ThreadTeam* team, std::size_t count, const Value& value) {
  std::atomic<double> maximum = 0.0;
  distribute(team, count, [&](std::size_t first, std::size_t last) {
    const double own = largest(first, last, value);
    double known = maximum;
    while (own > known && !maximum.compare_exchange_weak(known, own)) {
    }
  });
  return maximum;
}

double largest_velocity(const Grains& grains, ThreadTeam* team) {
  return std::sqrt(largest(team, static_cast<std::size_t>(grains.free_count), [&grains](std::size_t i) {
    return grains.vx[i] * grains.vx[i] + grains.vy[i] * grains.vy[i];
  }));
}

double largest_overlap(const Contacts& contacts) {
  return largest(std::size_t{0}, contacts.gap.size(),
                 [&contacts](std::size_t c) { return -contacts.gap[c]; });
}

/// Computes the first guess of the solve: the forces that persist from the last step, times h (T18).
void guess_impulses(const Contacts& contacts, double h, const solver::ContactProblem& problem,
                    ThreadTeam* team, solver::ContactSolution& solution) {
  const std::size_t count = contacts.count();
  solution.pn.resize(count);
  solution.pt.resize(count);
  distribute(team, count, [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c) {
      solution.pn[c] = contacts.fn[c] * h;
      solution.pt[c] = contacts.ft[c] * h;
    }
  });
  solution.pr.resize(contacts.moment.size());
  for (std::size_t c = 0; c < solution.pr.size(); ++c)
    solution.pr[c] = contacts.moment[c] * h / solver::rolling_length(problem, c);
}

/// Stores the impulses as mean forces over the step, so that the memory remains valid if h changes (T18).
void store_impulses(const solver::ContactProblem& problem, const solver::ContactSolution& solution, double h,
                    ThreadTeam* team, Contacts& contacts) {
  distribute(team, solution.pn.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c) {
      contacts.fn[c] = solution.pn[c] / h;
      contacts.ft[c] = solution.pt[c] / h;
    }
  });
  for (std::size_t c = 0; c < solution.pr.size(); ++c)
    contacts.moment[c] = solver::rolling_length(problem, c) * solution.pr[c] / h;  // (T41)
}

bool finite(const std::vector<double>& values, std::size_t first, std::size_t last) {
  std::int64_t count = 0;  // as wide as a double, so that the comparisons vectorise
  for (std::size_t i = first; i < last; ++i)
    count += std::fabs(values[i]) <= std::numeric_limits<double>::max() ? 1 : 0;
  return count == static_cast<std::int64_t>(last - first);
}

bool finite(const solver::ContactSolution& solution, ThreadTeam* team) {
  std::atomic<bool> all = true;
  distribute(team, solution.vx.size(), [&](std::size_t first, std::size_t last) {
    for (const auto* field : {&solution.vx, &solution.vy, &solution.omega})
      if (!finite(*field, first, last)) all = false;
  });
  return all;
}

/// Returns `least` times the smallest power of two that gives at least `value`; `value` itself if their ratio
/// is not finite.
double doubled_until(double least, double value) {
  const double ratio = value / least;
  if (!std::isfinite(ratio)) return value;
  int exponent = 0;
  const double mantissa = std::frexp(ratio, &exponent);
  return std::ldexp(least, mantissa > 0.5 ? exponent : exponent - 1);
}

/// Returns the gap up to which pairs are contacts, m. Two grains can approach each other at twice the largest
/// velocity, to which gravity adds g h within the step. The gap changes by doubling only, because one that
/// follows the fastest grain would add and remove pairs in nearly every step, and each change of the list of
/// contacts requires linking and ordering it again.
double detection_margin(const World& world, const StepSettings& settings, ThreadTeam* team) {
  const double approach =
      2.0 * settings.h * (largest_velocity(world.grains, team) + world.gravity * settings.h);
  return doubled_until(settings.margin, settings.margin + approach);
}

}  // namespace

StageSeconds begin_step(World& world, const StepSettings& settings, StepWorkspace& workspace) {
  StageSeconds seconds{};
  StageClock clock(seconds);
  const double h = settings.h;
  Grains& grains = world.grains;
  Contacts& contacts = workspace.contacts;
  ThreadTeam* const team = solver::solver_team(workspace.problem, settings.solver, workspace.solver);
  const double margin = detection_margin(world, settings, team);
  workspace.image.reserve(grains.image.size());
  begin_motion(world, h, team, workspace.before);
  clock.end_of(Stage::move);
  contact::detect_contacts(workspace.neighbours, grains, world.boundary, margin, contacts,
                           team);  // local frames (T3)
  clock.end_of(Stage::detect);
  contacts.moment.assign(settings.law.rolling_friction != 0.0 ? contacts.a.size() : 0, 0.0);
  contact::recall_forces(world.contacts, contacts, team);  // (T18)
  clock.end_of(Stage::recall);
  // (T4), (T5), (T8), (T11), (T12)
  form_problem(world, contacts, settings.law, h, settings.solver.tolerance, workspace.problem, team);
  guess_impulses(contacts, h, workspace.problem, team, workspace.solution);
  clock.end_of(Stage::assemble);
  return seconds;
}

StepReport step(World& world, const StepSettings& settings, StepWorkspace& workspace) {
  StepReport report;
  report.seconds = begin_step(world, settings, workspace);
  StageClock clock(report.seconds);
  const double h = settings.h;
  report.solver =
      solver::solve(workspace.problem, settings.solver, workspace.solver, workspace.solution);  // (T7)
  clock.end_of(Stage::solve);
  ThreadTeam* const team = solver::solver_team(workspace.problem, settings.solver, workspace.solver);
  if (!finite(workspace.solution, team)) {
    copy_positions(workspace.before, 0, free_grains(world), world.grains);
    throw Error(ExitCode::internal, fmt::format("step {}: a velocity is not finite", world.step + 1));
  }
  store_impulses(workspace.problem, workspace.solution, h, team, workspace.contacts);  // (T18)
  std::swap(world.contacts, workspace.contacts);
  clock.end_of(Stage::store);
  end_motion(workspace.solution, world, h, team, workspace.image);
  ++world.step;
  world.time += h;
  report.contacts = world.contacts.count();
  run_both(
      team, [&] { report.largest_overlap = largest_overlap(world.contacts); },
      [&] { report.motion = motion_of(world.grains); });
  clock.end_of(Stage::move);
  return report;
}

}  // namespace talus::dynamics
