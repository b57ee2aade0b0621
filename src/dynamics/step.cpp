#include "dynamics/step.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "contact/detection.h"
#include "contact/memory.h"
#include "core/errors.h"
#include "dynamics/form_problem.h"

namespace talus {
namespace {

/// Adds the wall time between its calls to the stages.
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
             Index count) {
  for (Index i = 0; i < count; ++i) position[i] += duration * velocity[i];
}

/// Whether all x are in [0, length), as they are in nearly every step.
bool are_wrapped(const Grains& grains, double length) {
  std::int64_t within = 0;  // as wide as a double, so that the comparisons vectorise
  for (Index i = 0; i < grains.free_count; ++i)
    within += static_cast<std::int64_t>(grains.x[i] >= 0.0) & static_cast<std::int64_t>(grains.x[i] < length);
  return within == grains.free_count;
}

/// Brings x back to [0, length).
void wrap(Grains& grains, double length) {
  if (are_wrapped(grains, length)) return;
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

/// Moves the free grains along their present velocities, (T2) and (T17); x stays in [0, length) of a periodic
/// bed.
void advance_positions(Grains& grains, const Boundary& boundary, double duration) {
  advance(grains.x, grains.vx, duration, grains.free_count);
  advance(grains.y, grains.vy, duration, grains.free_count);
  advance(grains.angle, grains.omega, duration, grains.free_count);
  if (boundary.periodic) wrap(grains, boundary.length);
}

/// Where a grain has passed the periodic edge since `image` was taken, its contacts see each other from
/// there: b touches a from x_b + shift L.
void follow_images(const Grains& grains, const std::vector<Index>& image, Contacts& contacts) {
  if (grains.image == image) return;
  const auto passed = [&grains, &image](Index i) { return grains.image[i] - image[i]; };
  for (Index c = 0; c < contacts.count(); ++c)
    if (contacts.b[c] < grains.count())  // a plane has no images
      contacts.shift[c] =
          static_cast<std::int8_t>(contacts.shift[c] + passed(contacts.b[c]) - passed(contacts.a[c]));
}

void copy_positions(const Grains& from, Grains& to) {
  to.x = from.x;
  to.y = from.y;
  to.angle = from.angle;
  to.image = from.image;
}

/// Largest of count values, not less than 0, in four strands: one would wait for each comparison.
template <typename Value>
double largest(Index count, Value value) {
  std::array<double, 4> strand{};
  Index i = 0;
  for (; i + 4 <= count; i += 4)
    for (Index k = 0; k < 4; ++k) strand[k] = std::max(strand[k], value(i + k));
  for (; i < count; ++i) strand[0] = std::max(strand[0], value(i));
  return *std::max_element(strand.begin(), strand.end());
}

double largest_velocity(const Grains& grains) {
  return std::sqrt(largest(grains.free_count, [&grains](Index i) {
    return grains.vx[i] * grains.vx[i] + grains.vy[i] * grains.vy[i];
  }));
}

double largest_overlap(const Contacts& contacts) {
  return largest(contacts.count(), [&contacts](Index c) { return -contacts.gap[c]; });
}

/// The first guess of the solve: the forces that persist from the last step, times h (T18).
void guess_impulses(const Contacts& contacts, double h, const ContactProblem& problem, ThreadTeam* team,
                    ContactSolution& solution) {
  const auto count = static_cast<std::size_t>(contacts.count());
  solution.pn.resize(count);
  solution.pt.resize(count);
  share_out(team, count, [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c) {
      solution.pn[c] = contacts.fn[c] * h;
      solution.pt[c] = contacts.ft[c] * h;
    }
  });
  solution.pr.resize(contacts.moment.size());
  for (std::size_t c = 0; c < solution.pr.size(); ++c)
    solution.pr[c] = contacts.moment[c] * h / rolling_length(problem, static_cast<Index>(c));
}

/// As mean forces over the step, so that a change of h keeps the memory (T18).
void store_impulses(const ContactProblem& problem, const ContactSolution& solution, double h,
                    ThreadTeam* team, Contacts& contacts) {
  share_out(team, solution.pn.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c) {
      contacts.fn[c] = solution.pn[c] / h;
      contacts.ft[c] = solution.pt[c] / h;
    }
  });
  for (std::size_t c = 0; c < solution.pr.size(); ++c)
    contacts.moment[c] = rolling_length(problem, static_cast<Index>(c)) * solution.pr[c] / h;  // (T41)
}

void set_velocities(const ContactSolution& solution, Grains& grains) {
  std::copy_n(solution.vx.begin(), grains.free_count, grains.vx.begin());
  std::copy_n(solution.vy.begin(), grains.free_count, grains.vy.begin());
  std::copy_n(solution.omega.begin(), grains.free_count, grains.omega.begin());
}

bool finite(const std::vector<double>& values) {
  std::int64_t count = 0;  // as wide as a double, so that the comparisons vectorise
  for (double value : values) count += std::fabs(value) <= std::numeric_limits<double>::max() ? 1 : 0;
  return count == static_cast<std::int64_t>(values.size());
}

bool finite(const ContactSolution& solution) {
  return finite(solution.vx) && finite(solution.vy) && finite(solution.omega);
}

/// Two grains can approach by twice the largest velocity, to which gravity adds g h within the step; m.
double detection_margin(const World& world, const StepSettings& settings) {
  return settings.margin + 2.0 * settings.h * (largest_velocity(world.grains) + world.gravity * settings.h);
}

}  // namespace

StageSeconds begin_step(World& world, const StepSettings& settings, StepWorkspace& workspace) {
  StageSeconds seconds{};
  StageClock clock(seconds);
  const double h = settings.h;
  Grains& grains = world.grains;
  Contacts& contacts = workspace.contacts;
  const double margin = detection_margin(world, settings);
  ThreadTeam* const team = team_at_hand(workspace.problem, settings.solver, workspace.solver);
  copy_positions(grains, workspace.before);
  advance_positions(grains, world.boundary, 0.5 * h);  // the midpoint (T2)
  clock.end_of(Stage::move);
  detect_contacts(workspace.neighbours, grains, world.boundary, margin, contacts, team);  // local frames (T3)
  clock.end_of(Stage::detect);
  contacts.moment.assign(settings.law.rolling_friction != 0.0 ? contacts.a.size() : 0, 0.0);
  recall_forces(world.contacts, contacts);  // (T18)
  clock.end_of(Stage::recall);
  free_velocity(world, h, workspace.problem);  // (T4)
  // (T5), (T8), (T11), (T12)
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
  Grains& grains = world.grains;
  report.solver = solve(workspace.problem, settings.solver, workspace.solver, workspace.solution);  // (T7)
  clock.end_of(Stage::solve);
  if (!finite(workspace.solution)) {
    copy_positions(workspace.before, grains);
    throw Error(ExitCode::internal, fmt::format("step {}: a velocity is not finite", world.step + 1));
  }
  ThreadTeam* const team = team_at_hand(workspace.problem, settings.solver, workspace.solver);
  store_impulses(workspace.problem, workspace.solution, h, team, workspace.contacts);  // (T18)
  std::swap(world.contacts, workspace.contacts);
  set_velocities(workspace.solution, grains);  // (T6)
  clock.end_of(Stage::store);
  workspace.image = grains.image;
  advance_positions(grains, world.boundary, 0.5 * h);  // the end of the step (T17)
  follow_images(grains, workspace.image, world.contacts);
  ++world.step;
  world.time += h;
  report.contacts = world.contacts.count();
  report.largest_overlap = largest_overlap(world.contacts);
  report.rms_velocity = rms_velocity(grains);
  clock.end_of(Stage::move);
  return report;
}

}  // namespace talus
