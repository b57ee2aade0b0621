#include "session/run_check.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <span>

#include "base/errors.h"
#include "core/snapshot.h"
#include "core/tensor.h"
#include "core/trigonometry.h"
#include "scenario/scenario.h"
#include "scenario/scripted_command.h"
#include "scenario/text.h"
#include "session/command.h"
#include "session/frame_state.h"
#include "session/run_header.h"
#include "session/session.h"

namespace talus::session {
namespace {

using scenario::short_text;

/// Faults found so far.
struct Findings {
  RunCheck& check;
  std::size_t more = 0;

  void add_changed(const std::string& what) {
    ++check.changed;
    add(what, "is not as it was written: its hash differs");
  }
  template <typename... Args>
  void add(const std::string& where, fmt::format_string<Args...> what, Args&&... args) {
    if (check.faults.size() < max_faults)
      check.faults.push_back(fmt::format("{}: {}", where, fmt::format(what, std::forward<Args>(args)...)));
    else
      ++more;
  }
};

bool all_finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

// --- series ---

/// Checks the steps of a run with lost data, which can only be required to ascend.
void check_remaining_steps(const std::vector<StepRow>& rows, Findings& found) {
  const auto later = [](const StepRow& one, const StepRow& other) {
    return at(one, StepField::step) >= at(other, StepField::step);
  };
  if (std::ranges::adjacent_find(rows, later) != rows.end()) found.add("/steps/step", "does not ascend");
}

/// Checks the series of steps. `begun`: steps taken before the first step of a branch, otherwise 0.
void check_steps(const std::vector<StepRow>& rows, std::int64_t begun, const io::Checkpoint& checkpoint,
                 Findings& found) {
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::int64_t step = begun + static_cast<std::int64_t>(k) + 1;
    if (at(rows[k], StepField::step) != static_cast<double>(step)) {
      found.add("/steps/step", "row {} is of step {}, expected {}", k,
                short_text(at(rows[k], StepField::step)), step);
      break;
    }
    if (!all_finite(rows[k])) found.add("/steps", "step {} has a value that is not finite", step);
  }
  if (checkpoint.world.step != begun + static_cast<std::int64_t>(rows.size()))
    found.add("/checkpoint/step", "{}, but /steps has {} rows", checkpoint.world.step, rows.size());
}

/// Checks the rows of a run. The first row of a branch, at step `begun`, need not know the overlap of its
/// step.
void check_observables(const std::vector<ObservableRow>& rows, double begun, double last_step,
                       bool lacks_values, Findings& found) {
  double before = -1.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double step = at(rows[k], Observable::step);
    if (!(step > before) || step > last_step)
      found.add("/observables/step", "row {} is of step {}, expected one after {}, up to {}", k,
                short_text(step), short_text(before), short_text(last_step));
    before = step;
    for (const Observable field : {Observable::time, Observable::tilt, Observable::kinetic_energy,
                                   Observable::volume_strain, Observable::largest_overlap})
      if (!lacks_values && !std::isfinite(at(rows[k], field)) &&
          !(field == Observable::largest_overlap && step == begun))
        found.add(
            std::string("/observables/").append(observable_fields[static_cast<std::size_t>(field)].name),
            "row {} is not finite", k);
  }
}

/// Whether the bed was at rest at a step; false if no row was recorded at it.
bool at_rest(const std::vector<ObservableRow>& rows, std::int64_t step) {
  const auto row =
      std::ranges::lower_bound(rows, static_cast<double>(step), {},
                               [](const ObservableRow& entry) { return at(entry, Observable::step); });
  return row != rows.end() && at(*row, Observable::step) == static_cast<double>(step) &&
         at(*row, Observable::at_rest) == 1.0;
}

// --- a frame ---

bool check_values(const BedFrame& bed, const std::string& name, Findings& found) {
  const std::pair<const char*, const std::vector<double>*> values[] = {
      {"position", &bed.frame.x},
      {"position", &bed.frame.y},
      {"angle", &bed.frame.angle},
      {"velocity", &bed.frame.vx},
      {"velocity", &bed.frame.vy},
      {"angular_velocity", &bed.frame.omega},
      {"contacts/force", &bed.frame.contacts.fn},
      {"contacts/force", &bed.frame.contacts.ft},
      {"contacts/moment", &bed.frame.contacts.moment}};
  bool finite = true;
  for (const auto& [set, numbers] : values) {
    if (all_finite(*numbers)) continue;
    found.add(name, "{} has a value that is not finite", set);
    finite = false;
  }
  // In single precision x may equal the period.
  const double room = 1e-5 * bed.statics.length;
  const auto outside = [&](double x) { return x < -room || x > bed.statics.length + room; };
  if (bed.statics.periodic && std::ranges::any_of(bed.frame.x, outside))
    found.add(name, "a grain lies outside the period of the bed");
  return finite;
}

/// Returns the largest overlap allowed, D: that of the guards of the run, or any if these only warn.
double overlap_allowed(const Scenario& scenario) {
  if (scenario.guards.action == scenario::GuardAction::warn) return std::numeric_limits<double>::infinity();
  return std::max(overlap_limit, scenario.guards.overlap);
}

/// Returns the overlap of a contact of two grains, m; 0 for a contact with a plane.
double overlap(const BedFrame& bed, std::size_t c) {
  const FrameContacts& contacts = bed.frame.contacts;
  if (contacts.b[c] >= bed.frame.grain_count()) return 0.0;
  const auto a = static_cast<std::size_t>(contacts.a[c]), b = static_cast<std::size_t>(contacts.b[c]);
  const double x =
      bed.frame.x[b] + static_cast<double>(contacts.shift[c]) * bed.statics.length - bed.frame.x[a];
  return bed.statics.radius[a] + bed.statics.radius[b] - std::hypot(x, bed.frame.y[b] - bed.frame.y[a]);
}

void check_contacts(const BedFrame& bed, double overlap_allowed, const std::string& name, Findings& found) {
  const FrameContacts& contacts = bed.frame.contacts;
  const double least = force_threshold(bed.statics);
  double deepest = 0.0, mobilised = 0.0;
  std::size_t pulling = 0;
  for (std::size_t c = 0; c < contacts.a.size(); ++c) {
    deepest = std::max(deepest, overlap(bed, c));
    if (contacts.fn[c] < 0.0) ++pulling;
    // Forces far below the weight of a grain have few significant digits in single precision.
    const double limit = friction_of_contact(bed.frame, c) * contacts.fn[c] + least;
    mobilised = std::max(mobilised, std::abs(contacts.ft[c]) / limit);
  }
  RunCheck& check = found.check;
  check.largest_overlap = std::max(check.largest_overlap, deepest / bed.statics.mean_diameter);
  check.largest_mobilisation = std::max(check.largest_mobilisation, mobilised);
  if (pulling > 0) found.add(name, "{} contacts pull; normal forces are >= 0", pulling);
  if (deepest > overlap_allowed * bed.statics.mean_diameter)
    found.add(name, "two grains overlap by {} D", short_text(deepest / bed.statics.mean_diameter));
  if (mobilised > mobilisation_limit)
    found.add(name, "a tangential force is {} mu f_n, Coulomb's law allows 1", short_text(mobilised));
}

/// Checks that moments stay within rolling friction (T38).
void check_rolling(const BedFrame& bed, double mu_r, const std::string& name, Findings& found) {
  const FrameContacts& contacts = bed.frame.contacts;
  if (contacts.moment.size() != (mu_r > 0.0 ? contacts.a.size() : 0)) {
    found.add(name, "{} moments of {} contacts, with contact.rolling_friction = {}", contacts.moment.size(),
              contacts.a.size(), short_text(mu_r));
    return;
  }
  const double least = force_threshold(bed.statics);
  double mobilised = 0.0;
  for (std::size_t c = 0; c < contacts.moment.size(); ++c) {
    const auto a = static_cast<std::size_t>(contacts.a[c]), b = static_cast<std::size_t>(contacts.b[c]);
    const double length = bed.statics.radius[a] + (b < bed.frame.x.size() ? bed.statics.radius[b] : 0.0);
    mobilised =
        std::max(mobilised, std::abs(contacts.moment[c]) / (length * (mu_r * contacts.fn[c] + least)));
  }
  if (mobilised > mobilisation_limit)
    found.add(name, "a moment is {} mu_r (r_a + r_b) f_n, rolling friction allows 1", short_text(mobilised));
}

/// Load of the contacts on each grain: the sum of forces, and the internal moment (paper, Eq. 4).
struct Loads {
  std::vector<Vector2> force;
  std::vector<Tensor2> moment;
};

Loads loads_of(const BedFrame& bed) {
  const std::size_t count = bed.frame.grain_count();
  Loads loads{std::vector<Vector2>(count, Vector2::Zero()), std::vector<Tensor2>(count)};
  const FrameContacts& contacts = bed.frame.contacts;
  // For the other body of a contact, lever arm and force both change sign, so their product does not.
  const auto add = [&](Index body, double sign, const Vector2& normal, const Vector2& force) {
    if (body >= bed.frame.grain_count()) return;  // plane
    const std::size_t grain = body;
    loads.force[grain] += sign * force;
    matrix(loads.moment[grain]) += bed.statics.radius[grain] * normal * force.transpose();  // (T19)
  };
  for (std::size_t c = 0; c < contacts.a.size(); ++c) {
    const Vector2 normal{contacts.nx[c], contacts.ny[c]}, tangent{-contacts.ny[c], contacts.nx[c]};
    const Vector2 force = contacts.fn[c] * normal + contacts.ft[c] * tangent;
    add(contacts.a[c], -1.0, normal, force);
    add(contacts.b[c], 1.0, normal, force);
  }
  for (std::size_t i = 0; i < count; ++i) {  // contribution of the spin (paper, Eq. 4)
    const double spin = 0.25 * bed.statics.mass[i] * std::pow(bed.statics.radius[i] * bed.frame.omega[i], 2);
    matrix(loads.moment[i]).diagonal().array() -= spin;
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
    found.add(name, "internal_moment does not match the contacts: it differs by {} of the largest",
              short_text(error / largest));
}

/// Returns the allowed imbalance, m g: twice the change of a velocity between the bounds of rest in a step.
double imbalance_allowed(const Scenario& scenario) {
  return std::max(imbalance_limit, 4.0 * scenario.deposition.rest_velocity);
}

/// Adds the force of the spring that drags a grain.
void add_drag(const io::RunFile& run, const Scenario& scenario, std::size_t k, std::int64_t step,
              Loads& loads) {
  const std::optional<Drag> drag = commanded_schedule(run, step).drag;
  if (!drag) return;
  const Vec2 pulled = drag_acceleration(*drag, scenario.grains.mean_diameter, scenario::time_step(scenario),
                                        world_at_frame(run, k));
  loads.force[drag->grain] += run.header().statics.mass[drag->grain] * Vector2{pulled.x, pulled.y};
}

/// Checks Newton's law for a bed at rest: forces balance the weight.
void check_balance(const BedFrame& bed, const Loads& loads, double imbalance_allowed, const std::string& name,
                   Findings& found) {
  double squares = 0.0;
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    const std::size_t k = i;
    const double weight = bed.statics.mass[k] * bed.statics.gravity;
    const double x = loads.force[k].x() / weight + sine(bed.frame.tilt);
    const double y = loads.force[k].y() / weight - cosine(bed.frame.tilt);
    squares += x * x + y * y;
  }
  const double imbalance =
      std::sqrt(squares / static_cast<double>(std::max<Index>(bed.statics.free_count, 1)));
  ++found.check.frames_at_rest;
  found.check.largest_imbalance = std::max(found.check.largest_imbalance, imbalance);
  if (imbalance > imbalance_allowed)
    found.add(name, "the bed is recorded as at rest, but forces and weight differ by {} m g (rms)",
              short_text(imbalance));
}

// --- data stored twice ---

bool is_same(double one, double other) { return one == other || (std::isnan(one) && std::isnan(other)); }

/// Checks that the parameters stored outside the scenario agree with it.
void check_parameters(const io::RunHeader& header, const Scenario& scenario, Findings& found) {
  const RunStatics& statics = header.statics;
  if (header.seed != scenario.seed) found.add("/provenance", "the seed is not that of the scenario");
  const double diameter = scenario.grains.mean_diameter;
  const std::pair<const char*, std::pair<double, double>> values[] = {
      {"mean_diameter", {statics.mean_diameter, diameter}},
      {"friction", {header.friction.grains, scenario.contact.friction}},
      {"depth", {statics.depth, scenario.bed.depth * diameter}},
      {"gravity", {statics.gravity, World().gravity}}};
  for (const auto& [name, pair] : values)
    if (!is_same(pair.first, pair.second))
      found.add(std::string("/parameters/").append(name), "is {}, but the scenario has {}",
                short_text(pair.first), short_text(pair.second));
}

/// Checks that the grains that have arrived are those of the last state.
void check_grains(const RunStatics& all, const World& world, Findings& found) {
  const RunStatics statics = arrived_statics(all, world.grains.count());
  if (statics.radius != world.grains.radius)
    found.add("/particles/grains/radius", "is not that of /checkpoint");
  if (statics.mass != world.grains.mass) found.add("/particles/grains/mass", "is not that of /checkpoint");
}

/// Checks that the results follow from the state of the run.
void check_results(const Scenario& scenario, const io::Checkpoint& checkpoint, Findings& found) try {
  const Figures results = Session(scenario, checkpoint, "/checkpoint").checkpoint(0.0).results;
  for (const auto& [name, value] : checkpoint.results)
    if (const auto expected = find_value(results, name); expected && !is_same(*expected, value))
      found.add("/results/" + name, "is {}, but the state of the run gives {}", short_text(value),
                short_text(*expected));
} catch (const Error& error) {
  found.add("/checkpoint", "{}", error.what());
}

/// Checks that a branch starts with a state of its scenario, and that its first frame is that state.
void check_branch(const io::RunFile& run, const Scenario& scenario, Findings& found) try {
  const io::BranchOrigin& branch = *run.header().branch;
  check_branch_start(branch, scenario, "the run");
  if (!run.lost().empty() || !run.has_frames() || run.all_frame_tilts().empty()) return;
  const Frame first = run.positions(0);
  const World& start = branch.start.world;
  const auto same = [](double one, double other) {
    return static_cast<float>(one) == static_cast<float>(other);
  };
  if (first.step != start.step || first.tilt != start.tilt ||
      !std::ranges::equal(first.x, start.grains.x, same) ||
      !std::ranges::equal(first.y, start.grains.y, same))
    found.add("/branch", "is not the state of the first frame");
} catch (const Error& error) {
  found.add("/branch", "{}", error.what());
}

}  // namespace

RunCheck check_run(const io::RunFile& run, const std::function<void(std::size_t)>& progress) {
  RunCheck check;
  Findings found{check};
  for (const std::string& path : run.changed_data_sets()) found.add_changed(path);
  const RunStatics& statics = run.header().statics;
  const std::vector<ObservableRow> rows = run.all_observables();
  const std::vector<StepRow> steps = run.steps();
  check.rows = rows.size();
  check.steps = steps.size();
  check.commands = run.commands().size();
  const bool lacks = !run.lost().empty();
  const std::int64_t begun = run.header().branch ? run.header().branch->start.world.step : 0;
  const std::int64_t last_step =
      lacks ? std::numeric_limits<std::int64_t>::max() : begun + static_cast<std::int64_t>(steps.size());
  if (lacks)
    check_remaining_steps(steps, found);
  else
    check_steps(steps, begun, run.checkpoint(), found);
  check_observables(rows, static_cast<double>(begun), static_cast<double>(last_step), lacks, found);
  const Scenario scenario = runs::stored_scenario(run.header(), "/parameters/scenario_resolved");
  check_parameters(run.header(), scenario, found);
  if (run.header().branch) check_branch(run, scenario, found);
  if (run.has_state()) {
    check_grains(statics, run.checkpoint().world, found);
    check_results(scenario, run.checkpoint(), found);
  }
  const bool is_dragged =
      run.has_state() &&
      (std::ranges::any_of(
           run.commands(), [](CommandKind kind) { return kind == CommandKind::drag; }, &Command::kind) ||
       (run.header().branch && find_value(run.header().branch->start.integers, "drag_grain")));
  std::int64_t before = -1;
  for (std::size_t k = 0; run.has_frames() && k < run.all_frame_tilts().size(); ++k, ++check.frames) {
    const std::string name = fmt::format("frame {}", k);
    try {
      Frame frame = run.stored_frame(k);
      if (!run.is_as_written(frame, k)) found.add_changed(name);
      if (frame.step <= before || frame.step > last_step)
        found.add("/frames/step", "{} is of step {}, after one of step {}", name, frame.step, before);
      before = frame.step;
      // A lost command can have set any friction.
      if (may_lack_commands(run)) frame.friction.grains = scenario::largest_friction;
      const BedFrame bed{frame, statics};
      if (check_values(bed, name, found)) {
        check_contacts(bed, overlap_allowed(scenario), name, found);
        check_rolling(bed, scenario.contact.rolling_friction, name, found);
        Loads loads = loads_of(bed);
        check_moments(frame, loads, name, found);
        if (is_dragged) add_drag(run, scenario, k, frame.step, loads);
        if (at_rest(rows, frame.step) && !may_lack_commands(run))
          check_balance(bed, loads, imbalance_allowed(scenario), name, found);
      }
    } catch (const Error& error) {
      found.add(name, "{}", error.what());
    }
    if (progress) progress(k + 1);
  }
  if (found.more > 0) check.faults.push_back(fmt::format("and {} more", found.more));
  return check;
}

}  // namespace talus::session
