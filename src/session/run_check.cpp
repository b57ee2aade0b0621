#include "session/run_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/errors.h"
#include "core/trigonometry.h"
#include "session/run_header.h"
#include "session/scenario.h"
#include "session/scenario_text.h"

namespace talus {
namespace {

constexpr double smallest_force = 1e-9;  // m g

/// The faults found so far, and where.
struct Findings {
  RunCheck& check;
  std::size_t more = 0;

  std::size_t count() const { return check.faults.size() + more; }

  void add(const std::string& where, const std::string& what) {
    if (check.faults.size() < most_faults)
      check.faults.push_back(std::string(where).append(": ").append(what));
    else
      ++more;
  }
};

std::string frame_name(std::size_t k) { return "frame " + std::to_string(k); }

bool all_finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

/// Friction of contacts between grains, and with side walls.
struct Frictions {
  double grains = 0.0, walls = 0.0;
};

/// The friction in force at a step: the scenario's, or what a command has set.
double friction_at(const RunFile& run, double given, std::int64_t step) {
  for (const Command& command : run.commands())
    if (command.kind == CommandKind::friction && command.step < step) given = command.x;
  return given;
}

/// Of frame k: the first has the forces of the last step of the deposition.
Frictions frictions_of(const RunFile& run, const Scenario& scenario, std::size_t k, const Frame& frame) {
  Frictions mu{scenario.contact.friction, scenario.contact.wall_friction};
  if (k == 0 && frame.tilt == 0.0)
    mu = {scenario.deposition.friction.value_or(mu.grains),
          scenario.deposition.wall_friction.value_or(mu.walls)};
  mu.grains = friction_at(run, mu.grains, frame.step);
  return mu;
}

// --- series ---

/// A run that lacks some of what it held: its steps ascend, and that is all that they can be asked.
void check_remaining_steps(const std::vector<StepRow>& rows, Findings& found) {
  const auto later = [](const StepRow& one, const StepRow& other) {
    return at(one, StepField::step) >= at(other, StepField::step);
  };
  if (std::ranges::adjacent_find(rows, later) != rows.end()) found.add("/steps/step", "does not ascend");
}

void check_steps(const std::vector<StepRow>& rows, const Checkpoint& checkpoint, Findings& found) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (at(rows[k], StepField::step) != static_cast<double>(k + 1)) {
      found.add("/steps/step", "row " + std::to_string(k) + " is of step " +
                                   short_text(at(rows[k], StepField::step)) + ", expected " +
                                   std::to_string(k + 1));
      break;
    }
    if (!all_finite(rows[k]))
      found.add("/steps", "step " + std::to_string(k + 1) + " has a value that is not finite");
  }
  if (checkpoint.world.step != static_cast<std::int64_t>(rows.size()))
    found.add("/checkpoint/step", std::to_string(checkpoint.world.step) + ", but /steps has " +
                                      std::to_string(rows.size()) + " rows");
}

void check_observables(const std::vector<ObservableRow>& rows, double last_step, bool lacks_values,
                       Findings& found) {
  double before = -1.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double step = at(rows[k], Observable::step);
    if (!(step > before) || step > last_step)
      found.add("/observables/step", "row " + std::to_string(k) + " is of step " + short_text(step) +
                                         ", expected one after " + short_text(before) + ", up to " +
                                         short_text(last_step));
    before = step;
    for (const Observable field : {Observable::time, Observable::tilt, Observable::kinetic_energy,
                                   Observable::volume_strain, Observable::largest_overlap})
      if (!lacks_values && !std::isfinite(at(rows[k], field)))
        found.add(
            std::string("/observables/").append(observable_fields[static_cast<std::size_t>(field)].name),
            "row " + std::to_string(k) + " is not finite");
  }
}

/// Whether the bed was at rest at a step; where no row was recorded then, it is taken to have moved.
bool at_rest(const std::vector<ObservableRow>& rows, std::int64_t step) {
  const auto row = std::ranges::lower_bound(rows, static_cast<double>(step), {},
                                            [](const ObservableRow& of) { return at(of, Observable::step); });
  return row != rows.end() && at(*row, Observable::step) == static_cast<double>(step) &&
         at(*row, Observable::at_rest) == 1.0;
}

// --- a frame ---

bool check_values(const Frame& frame, const RunStatics& statics, const std::string& name, Findings& found) {
  const std::pair<const char*, const std::vector<double>*> values[] = {
      {"position", &frame.x},
      {"position", &frame.y},
      {"angle", &frame.angle},
      {"velocity", &frame.vx},
      {"velocity", &frame.vy},
      {"angular_velocity", &frame.omega},
      {"contacts/force", &frame.contacts.fn},
      {"contacts/force", &frame.contacts.ft}};
  bool finite = true;
  for (const auto& [set, of] : values) {
    if (all_finite(*of)) continue;
    found.add(name, std::string(set).append(" has a value that is not finite"));
    finite = false;
  }
  // In single precision the period itself can be reached.
  const double room = 1e-5 * statics.length;
  const auto outside = [&](double x) { return x < -room || x > statics.length + room; };
  if (statics.periodic && std::ranges::any_of(frame.x, outside))
    found.add(name, "a grain lies outside the period of the bed");
  return finite;
}

/// Overlap of a contact of two grains, m; 0 for one with a plane.
double overlap(const Frame& frame, const RunStatics& statics, std::size_t c) {
  const FrameContacts& contacts = frame.contacts;
  if (contacts.b[c] >= frame.grain_count()) return 0.0;
  const auto a = static_cast<std::size_t>(contacts.a[c]), b = static_cast<std::size_t>(contacts.b[c]);
  const double x = frame.x[b] + static_cast<double>(contacts.shift[c]) * statics.length - frame.x[a];
  return statics.radius[a] + statics.radius[b] - std::hypot(x, frame.y[b] - frame.y[a]);
}

void check_contacts(const Frame& frame, const RunStatics& statics, const Frictions& mu,
                    const std::string& name, Findings& found) {
  const FrameContacts& contacts = frame.contacts;
  const double unit = statics.mass.empty() ? 1.0 : statics.mass.front() * statics.gravity;
  double deepest = 0.0, mobilised = 0.0;
  std::size_t pulling = 0;
  for (std::size_t c = 0; c < contacts.a.size(); ++c) {
    deepest = std::max(deepest, overlap(frame, statics, c));
    if (contacts.fn[c] < 0.0) ++pulling;
    const bool wall = contacts.b[c] >= frame.grain_count() && std::abs(contacts.nx[c]) > 0.5;
    // Forces far below the weight of a grain have few digits in single precision.
    const double limit = (wall ? mu.walls : mu.grains) * contacts.fn[c] + smallest_force * unit;
    mobilised = std::max(mobilised, std::abs(contacts.ft[c]) / limit);
  }
  RunCheck& check = found.check;
  check.largest_overlap = std::max(check.largest_overlap, deepest / statics.mean_diameter);
  check.largest_mobilisation = std::max(check.largest_mobilisation, mobilised);
  if (pulling > 0) found.add(name, std::to_string(pulling) + " contacts pull; normal forces are >= 0");
  if (deepest > overlap_limit * statics.mean_diameter)
    found.add(name, "two grains overlap by " + short_text(deepest / statics.mean_diameter) + " D");
  if (mobilised > mobilisation_limit)
    found.add(name, "a tangential force is " + short_text(mobilised) + " mu f_n, Coulomb's law allows 1");
}

/// What contacts give each grain: the sum of forces, and the internal moment (paper, Eq. 4).
struct Loads {
  std::vector<Vec2> force;
  std::vector<Tensor2> moment;
};

Loads loads_of(const Frame& frame, const RunStatics& statics) {
  const auto count = static_cast<std::size_t>(frame.grain_count());
  Loads loads{std::vector<Vec2>(count), std::vector<Tensor2>(count)};
  const FrameContacts& contacts = frame.contacts;
  // On the other side of a contact lever and force are both opposite: the moment is not.
  const auto add = [&](Index body, double sign, Vec2 normal, Vec2 force) {
    if (body >= frame.grain_count()) return;  // a plane
    const auto grain = static_cast<std::size_t>(body);
    loads.force[grain].x += sign * force.x;
    loads.force[grain].y += sign * force.y;
    const double lever = statics.radius[grain];
    Tensor2& moment = loads.moment[grain];
    moment.xx += lever * normal.x * force.x;
    moment.xy += lever * normal.x * force.y;
    moment.yx += lever * normal.y * force.x;
    moment.yy += lever * normal.y * force.y;
  };
  for (std::size_t c = 0; c < contacts.a.size(); ++c) {
    const Vec2 normal{contacts.nx[c], contacts.ny[c]};
    const Vec2 force{contacts.fn[c] * normal.x - contacts.ft[c] * normal.y,
                     contacts.fn[c] * normal.y + contacts.ft[c] * normal.x};
    add(contacts.a[c], -1.0, normal, force);
    add(contacts.b[c], 1.0, normal, force);
  }
  for (std::size_t i = 0; i < count; ++i) {  // of what spins (paper, Eq. 4)
    const double spin = 0.25 * statics.mass[i] * std::pow(statics.radius[i] * frame.omega[i], 2);
    loads.moment[i].xx -= spin;
    loads.moment[i].yy -= spin;
  }
  return loads;
}

void check_moments(const Frame& frame, const Loads& loads, const std::string& name, Findings& found) {
  double largest = 0.0, error = 0.0;
  for (std::size_t i = 0; i < loads.moment.size(); ++i) {
    const Tensor2 &here = loads.moment[i], &stored = frame.internal_moment[i];
    for (const auto& [one, other] :
         {std::pair{here.xx, stored.xx}, {here.xy, stored.xy}, {here.yx, stored.yx}, {here.yy, stored.yy}}) {
      largest = std::max(largest, std::abs(one));
      error = std::max(
          error, std::isfinite(other) ? std::abs(one - other) : std::numeric_limits<double>::infinity());
    }
  }
  if (largest == 0.0) return;
  found.check.largest_moment_error = std::max(found.check.largest_moment_error, error / largest);
  if (error > moment_error_limit * largest)
    found.add(name, "internal_moment is not that of the contacts: it differs by " +
                        short_text(error / largest) + " of the largest");
}

/// Newton's law of a bed at rest: forces carry the weight.
void check_balance(const Frame& frame, const Loads& loads, const RunStatics& statics, const std::string& name,
                   Findings& found) {
  double squares = 0.0;
  for (Index i = 0; i < statics.free_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double weight = statics.mass[k] * statics.gravity;
    const double x = loads.force[k].x / weight + sine(frame.tilt);
    const double y = loads.force[k].y / weight - cosine(frame.tilt);
    squares += x * x + y * y;
  }
  const double imbalance = std::sqrt(squares / static_cast<double>(std::max<Index>(statics.free_count, 1)));
  ++found.check.frames_at_rest;
  found.check.largest_imbalance = std::max(found.check.largest_imbalance, imbalance);
  if (imbalance > imbalance_limit)
    found.add(name, "the bed is said to be at rest, but forces and weight differ by " +
                        short_text(imbalance) + " m g (rms)");
}

}  // namespace

RunCheck check_run(const RunFile& run, const std::function<void(std::size_t)>& progress) {
  RunCheck check;
  Findings found{check};
  const RunStatics& statics = run.header().statics;
  const std::vector<ObservableRow> rows = run.all_observables();
  const std::vector<StepRow> steps = run.steps();
  check.rows = rows.size();
  check.steps = steps.size();
  check.commands = run.commands().size();
  const bool lacks = !run.lost().empty();
  const std::int64_t last_step =
      lacks ? std::numeric_limits<std::int64_t>::max() : static_cast<std::int64_t>(steps.size());
  if (lacks)
    check_remaining_steps(steps, found);
  else
    check_steps(steps, run.checkpoint(), found);
  check_observables(rows, static_cast<double>(last_step), lacks, found);
  const Scenario scenario = stored_scenario(run.header(), "/parameters/scenario_resolved");
  std::int64_t before = -1;
  for (std::size_t k = 0; k < run.all_frame_tilts().size(); ++k, ++check.frames) {
    const std::string name = frame_name(k);
    const std::size_t faults_before = found.count();
    try {
      const Frame frame = run.frame(k);
      if (frame.step <= before || frame.step > last_step)
        found.add("/frames/step", name + " is of step " + std::to_string(frame.step) +
                                      ", after one of step " + std::to_string(before));
      before = frame.step;
      if (check_values(frame, statics, name, found)) {
        check_contacts(frame, statics, frictions_of(run, scenario, k, frame), name, found);
        const Loads loads = loads_of(frame, statics);
        check_moments(frame, loads, name, found);
        if (at_rest(rows, frame.step)) check_balance(frame, loads, statics, name, found);
      }
    } catch (const Error& error) {
      found.add(name, error.what());
    }
    if (found.count() > faults_before) check.faulty_frames.push_back(k);
    if (progress) progress(k + 1);
  }
  if (found.more > 0) check.faults.push_back("and " + std::to_string(found.more) + " more");
  return check;
}

}  // namespace talus
