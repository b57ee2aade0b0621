#include "dynamics/step.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "contact/detection.h"
#include "contact/memory.h"
#include "core/errors.h"
#include "dynamics/assemble.h"

namespace talus {
namespace {

/// Adds the wall time between its calls to the stages of a report.
class StageClock {
 public:
  explicit StageClock(StepReport& report) : report_(report), last_(Clock::now()) {}

  void end_of(Stage stage) {
    const Clock::time_point now = Clock::now();
    report_.seconds[static_cast<std::size_t>(stage)] += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  StepReport& report_;
  Clock::time_point last_;
};

void advance(std::vector<double>& position, const std::vector<double>& velocity, double duration,
             Index count) {
  for (Index i = 0; i < count; ++i) position[i] += duration * velocity[i];
}

/// Brings x back to [0, length).
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

/// Moves the free grains along their present velocities; x stays in [0, length) of a periodic bed.
void move(Grains& grains, const Boundary& boundary, double duration) {
  advance(grains.x, grains.vx, duration, grains.free_count);
  advance(grains.y, grains.vy, duration, grains.free_count);
  advance(grains.angle, grains.omega, duration, grains.free_count);
  if (boundary.periodic) wrap(grains, boundary.length);
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

/// The first guess: forces of the last step times h.
void guess_impulses(const Contacts& contacts, double h, ContactSolution& solution) {
  const auto count = static_cast<std::size_t>(contacts.count());
  solution.pn.resize(count);
  solution.pt.resize(count);
  for (std::size_t c = 0; c < count; ++c) {
    solution.pn[c] = contacts.fn[c] * h;
    solution.pt[c] = contacts.ft[c] * h;
  }
}

void store_forces(const ContactSolution& solution, double h, Contacts& contacts) {
  for (std::size_t c = 0; c < solution.pn.size(); ++c) {
    contacts.fn[c] = solution.pn[c] / h;
    contacts.ft[c] = solution.pt[c] / h;
  }
}

void store_velocities(const ContactSolution& solution, Grains& grains) {
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

void form_problem(World& world, const StepSettings& settings, StepWorkspace& workspace, StageClock& clock) {
  const double h = settings.h;
  Grains& grains = world.grains;
  Contacts& contacts = workspace.contacts;
  // Two grains can approach by twice the largest velocity; gravity adds g h to it within the step.
  const double margin = settings.margin + 2.0 * h * (largest_velocity(grains) + world.gravity * h);
  copy_positions(grains, workspace.before);
  move(grains, world.boundary, 0.5 * h);
  clock.end_of(Stage::move);
  detect_contacts(workspace.neighbours, grains, world.boundary, margin, contacts);
  clock.end_of(Stage::detect);
  assemble(world, contacts, settings.law, h, workspace.problem);
  clock.end_of(Stage::assemble);
  recall_forces(world.contacts, contacts);
  guess_impulses(contacts, h, workspace.solution);
  clock.end_of(Stage::recall);
}

}  // namespace

void form_problem(World& world, const StepSettings& settings, StepWorkspace& workspace) {
  StepReport unused;
  StageClock clock(unused);
  form_problem(world, settings, workspace, clock);
}

StepReport step(World& world, const StepSettings& settings, StepWorkspace& workspace) {
  StepReport report;
  StageClock clock(report);
  const double h = settings.h;
  Grains& grains = world.grains;
  Contacts& contacts = workspace.contacts;
  form_problem(world, settings, workspace, clock);
  report.solver = solve(workspace.problem, settings.solver, workspace.solver, workspace.solution);
  clock.end_of(Stage::solve);
  if (!finite(workspace.solution)) {
    copy_positions(workspace.before, grains);
    throw Error(ExitCode::internal, "step " + std::to_string(world.step + 1) + ": a velocity is not finite");
  }
  store_forces(workspace.solution, h, contacts);
  store_velocities(workspace.solution, grains);
  std::swap(world.contacts, contacts);
  clock.end_of(Stage::store);
  move(grains, world.boundary, 0.5 * h);
  ++world.step;
  world.time += h;
  report.contacts = world.contacts.count();
  report.largest_overlap = largest_overlap(world.contacts);
  report.rms_velocity = rms_velocity(grains);
  clock.end_of(Stage::move);
  return report;
}

}  // namespace talus
