#include "session/measure.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "scenario/text.h"
#include "stress/free_surface.h"
#include "stress/stress.h"

namespace talus::session {

GuardValues guard_values(const World& world, const dynamics::StepReport& report, std::int64_t unconverged,
                         const Scenario& scenario) {
  const Motion& motion = report.motion;
  const double diameter = scenario.grains.mean_diameter;
  return {motion.largest_velocity / std::sqrt(world.gravity * diameter), report.largest_overlap / diameter,
          motion.kinetic_energy / (motion.mass * world.gravity * scenario.bed.depth * diameter),
          static_cast<double>(unconverged)};
}

GuardValues guard_limits(const Scenario& scenario) {
  const Scenario::Guards& guards = scenario.guards;
  return {guards.velocity, guards.overlap, guards.energy, static_cast<double>(guards.unconverged)};
}

std::string guard_message(std::size_t k, double value, double limit, std::int64_t step) {
  constexpr std::array<std::string_view, guard_count> found = {
      "a grain moves at {} sqrt(g D)", "two grains overlap by {} D",
      "the mean kinetic energy of a grain is {} m g H", "{} consecutive steps did not reach their tolerance"};
  return fmt::format("step {}: {}; guards.{} allows {}", step,
                     fmt::format(fmt::runtime(found[k]), scenario::short_text(value)), guard_names[k],
                     scenario::short_text(limit));
}

namespace {

ContactStatus status_of(const World& world, const dynamics::ContactLawParameters& law, Index c) {
  const Index plane = world.contacts.b[c] - world.grains.count();
  const bool is_of_wall = plane >= 0 && world.boundary.planes[plane].wall;
  return stress::contact_status(world.contacts.fn[c], world.contacts.ft[c],
                                is_of_wall ? law.wall_friction : law.friction);
}

void append_contact(const World& world, const dynamics::ContactLawParameters& law, Index c,
                    FrameContacts& out) {
  const Contacts& contacts = world.contacts;
  const Index a = contacts.a[c];
  out.a.push_back(a);
  out.b.push_back(contacts.b[c]);
  out.shift.push_back(contacts.shift[c]);
  out.nx.push_back(contacts.nx[c]);
  out.ny.push_back(contacts.ny[c]);
  out.px.push_back(world.grains.x[a] + world.grains.radius[a] * contacts.nx[c]);
  out.py.push_back(world.grains.y[a] + world.grains.radius[a] * contacts.ny[c]);
  out.fn.push_back(contacts.fn[c]);
  out.ft.push_back(contacts.ft[c]);
  out.status.push_back(status_of(world, law, c));
  if (!contacts.moment.empty()) out.moment.push_back(contacts.moment[c]);
}

FrameContacts carrying_contacts(const World& world, const dynamics::ContactLawParameters& law) {
  const double threshold = force_threshold(world.grains.mass, world.grains.free_count, world.gravity);
  FrameContacts carrying;
  for (Index c = 0; c < world.contacts.count(); ++c)
    if (world.contacts.fn[c] >= threshold) append_contact(world, law, c, carrying);
  return carrying;
}

double critical_fraction(const FrameContacts& carrying) {
  const auto critical = std::ranges::count(carrying.status, ContactStatus::sliding);
  return carrying.count() > 0 ? static_cast<double>(critical) / carrying.count() : 0.0;
}

/// Moves x below the period in single precision, because files store positions in single precision, where a
/// value just below the period may round to it, and texts have the same number of digits.
double within_period(double x, double period) {
  const auto end = static_cast<float>(period);
  return static_cast<float>(x) >= end ? std::nextafter(end, 0.0F) : x;
}

}  // namespace

Baseline measure_baseline(const World& world) {
  return {stress::bed_volume(world.grains, world.boundary), stress::centre_of_mass_height(world.grains)};
}

ObservableRow measure(const World& world, const RowContext& context) {
  std::vector<Tensor2> moments;
  stress::internal_moments(world.grains, world.contacts, moments);
  const Tensor2 sum = stress::sum_of_moments(moments, 0, world.grains.free_count);
  const double volume = stress::bed_volume(world.grains, world.boundary);
  const FrameContacts carrying = carrying_contacts(world, context.law);
  ObservableRow row{};
  at(row, Observable::step) = static_cast<double>(world.step);
  at(row, Observable::time) = world.time;
  at(row, Observable::tilt) = world.tilt;
  at(row, Observable::sigma_n) = sum.yy / volume;
  // The paper's y axis points into the bed, ours out of it, so the shear component changes sign.
  at(row, Observable::sigma_t) = -sum.yx / volume;
  at(row, Observable::sigma_t_over_n) = -sum.yx / sum.yy;
  at(row, Observable::stress_ratio) = stress::stress_state(sum).ratio;
  at(row, Observable::solid_fraction) = stress::solid_area(world.grains) / volume;
  at(row, Observable::coordination_number) = stress::coordination_number(
      stress::contacts_of_grains(carrying.a, carrying.b, world.grains.free_count));
  at(row, Observable::critical_fraction) = critical_fraction(carrying);
  at(row, Observable::volume_strain) = volume / context.baseline.volume - 1.0;
  at(row, Observable::centre_of_mass_strain) =
      stress::centre_of_mass_height(world.grains) / context.baseline.centre_of_mass_height - 1.0;
  at(row, Observable::surface_displacement) = context.surface_displacement;
  at(row, Observable::kinetic_energy) = kinetic_energy(world.grains);
  at(row, Observable::rms_velocity) = rms_velocity(world.grains);
  at(row, Observable::largest_overlap) = context.largest_overlap;
  at(row, Observable::residual) = context.residual;
  at(row, Observable::at_rest) = context.at_rest ? 1.0 : 0.0;
  return row;
}

StepRow step_row(const World& world, const dynamics::StepReport& report, double phase) {
  StepRow row{};
  at(row, StepField::step) = static_cast<double>(world.step);
  at(row, StepField::phase) = phase;
  at(row, StepField::contacts) = report.contacts;
  at(row, StepField::iterations) = report.solver.iterations;
  at(row, StepField::residual) = report.solver.residual.eta;
  at(row, StepField::converged) = report.solver.converged ? 1.0 : 0.0;
  at(row, StepField::rms_velocity) = report.motion.rms_velocity;
  return row;
}

Frame make_frame(const World& world, const dynamics::ContactLawParameters& law) {
  const Grains& grains = world.grains;
  Frame frame;
  frame.step = world.step;
  frame.time = world.time;
  frame.tilt = world.tilt;
  frame.friction = {law.friction, law.wall_friction};
  frame.x = grains.x;
  if (world.boundary.periodic)
    for (double& x : frame.x) x = within_period(x, world.boundary.length);
  frame.y = grains.y;
  frame.angle = grains.angle;
  frame.vx = grains.vx;
  frame.vy = grains.vy;
  frame.omega = grains.omega;
  frame.image = grains.image;
  stress::internal_moments(grains, world.contacts, frame.internal_moment);
  frame.gamma.reserve(frame.internal_moment.size());
  for (const Tensor2& moment : frame.internal_moment)
    frame.gamma.push_back(stress::stress_state(moment).ratio);
  frame.contacts = carrying_contacts(world, law);
  clear_unloaded_grains(frame);
  return frame;
}

}  // namespace talus::session
