#include "session/command.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <optional>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "scenario/scripted_command.h"
#include "stress/free_surface.h"

namespace talus::session {

namespace {

[[noreturn]] void refuse(const Command& command, const std::string& fault) {
  throw Error(ExitCode::usage, "{}: {}", name_of(command.kind), fault);
}

/// Returns the vector from the centre of the grain to the point where the spring is held, m; the shortest one
/// in a periodic bed.
Vec2 drag_offset(const Drag& drag, const World& world) {
  return {offset_along(world.boundary, world.grains.x[drag.grain], drag.x),
          drag.y - world.grains.y[drag.grain]};
}

void check_drag(const Command& command, const Scenario& scenario, const World& world) {
  const double farthest = farthest_drag * scenario.grains.mean_diameter;
  const Vec2 way = drag_offset({command.grain, command.x, command.y}, world);
  const double distance = std::sqrt(way.x * way.x + way.y * way.y);
  if (!(distance <= farthest))
    refuse(command, fmt::format("held {:.4g} m from the grain, expected at most {:g} D = {:.4g} m", distance,
                                farthest_drag, farthest));
}

/// The last row up to a step and the first row after it, which are the same at the end of the run. None
/// exists before the first row.
struct RowsAround {
  const ObservableRow *before, *after;
};
std::optional<RowsAround> rows_around(std::int64_t step, std::span<const ObservableRow> rows) {
  const auto wanted = static_cast<double>(step);
  const auto after = std::ranges::partition_point(
      rows, [wanted](const ObservableRow& row) { return at(row, Observable::step) <= wanted; });
  if (after == rows.begin()) return std::nullopt;
  const ObservableRow* const before = &*std::prev(after);
  return RowsAround{before, after == rows.end() ? before : &*after};
}

/// Interpolates a value linearly in the steps.
double between(double step, double first, double first_value, double last, double last_value) {
  return step <= first || last <= first
             ? first_value
             : first_value + (last_value - first_value) * ((step - first) / (last - first));
}

}  // namespace

std::string_view name_of(CommandKind kind) { return command_kind_names.at(static_cast<std::size_t>(kind)); }

std::string command_text(const Command& command) {
  switch (command.kind) {
    case CommandKind::push:
      return fmt::format("push grain {} by ({:.4g}, {:.4g}) m/s", command.grain, command.x, command.y);
    case CommandKind::drop:
      return fmt::format("drop {} grains at x = {:.4g} m from {:.4g} m above the surface", command.grain,
                         command.x, command.y);
    case CommandKind::friction:
      return fmt::format("friction {:.4g}", command.x);
    case CommandKind::drag:
      return fmt::format("drag grain {} to ({:.4g}, {:.4g}) m", command.grain, command.x, command.y);
    case CommandKind::release:
      return "release the grain";
    case CommandKind::tilt_rate:
      break;
  }
  return command.x == 0.0 ? "hold the tilt" : fmt::format("tilt rate {:.4g} deg/s", command.x);
}

void check_command(const Command& command, const Scenario& scenario, const World& world) {
  const std::string fault = scenario::command_fault(command, scenario, world.grains.free_count);
  if (!fault.empty()) refuse(command, fault);
  if (command.kind == CommandKind::drag) check_drag(command, scenario, world);
}

std::vector<Command> given_commands(std::span<const Command> commands) {
  std::vector<Command> given;
  std::optional<Index> dragged;
  for (const Command& command : commands) {
    const bool continues_drag = command.kind == CommandKind::drag && dragged == command.grain;
    if (command.kind == CommandKind::drag) dragged = command.grain;
    if (command.kind == CommandKind::release) dragged.reset();
    if (!continues_drag && command.kind != CommandKind::release) given.push_back(command);
  }
  return given;
}

std::vector<ObservableRow> rows_up_to(std::span<const ObservableRow> rows, std::int64_t step, double time,
                                      double tilt) {
  std::vector<ObservableRow> all(rows.begin(), rows.end());
  if (all.empty() || at(all.back(), Observable::step) >= static_cast<double>(step)) return all;
  ObservableRow& last = all.emplace_back();
  at(last, Observable::step) = static_cast<double>(step);
  at(last, Observable::time) = time;
  at(last, Observable::tilt) = tilt;
  return all;
}

double tilt_before(const Command& command, std::span<const Command> commands,
                   std::span<const ObservableRow> rows) {
  const auto around = rows_around(command.step, rows);
  if (!around) return std::nan("");
  const auto step = static_cast<double>(command.step);
  const double first = at(*around->before, Observable::step);
  double last = at(*around->after, Observable::step), last_tilt = at(*around->after, Observable::tilt);
  const double h =
      (at(*around->after, Observable::time) - at(*around->before, Observable::time)) / (last - first);
  // Proceeds backwards from the later row: each command that set the rate determines the tilt from there on.
  for (auto change = commands.rbegin(); change != commands.rend(); ++change) {
    const auto set = static_cast<double>(change->step);
    if (change->kind != CommandKind::tilt_rate || set <= first || set >= last) continue;
    const double tilt = last_tilt - radians(change->x) * h * (last - set);
    if (set <= step) return between(step, set, tilt, last, last_tilt);
    last = set;
    last_tilt = tilt;
  }
  return between(step, first, at(*around->before, Observable::tilt), last, last_tilt);
}

double time_before(const Command& command, std::span<const ObservableRow> rows) {
  const auto around = rows_around(command.step, rows);
  if (!around) return std::nan("");
  return between(static_cast<double>(command.step), at(*around->before, Observable::step),
                 at(*around->before, Observable::time), at(*around->after, Observable::step),
                 at(*around->after, Observable::time));
}

Vec2 drag_acceleration(const Drag& drag, double mean_diameter, double h, const World& world) {
  constexpr double longest_step = 0.25;  // 1 / w
  const double w = std::min(std::sqrt(drag_stiffness * world.gravity / mean_diameter), longest_step / h);
  const Vec2 way = drag_offset(drag, world);
  return {w * (w * way.x - 2.0 * world.grains.vx[drag.grain]),
          w * (w * way.y - 2.0 * world.grains.vy[drag.grain])};
}

void pull(const Drag& drag, double mean_diameter, double h, World& world) {
  const Vec2 acceleration = drag_acceleration(drag, mean_diameter, h, world);
  world.grains.vx[drag.grain] += h * acceleration.x;
  world.grains.vy[drag.grain] += h * acceleration.y;
}

// Lifts grains from the free surface and drops them elsewhere.

namespace {

/// Gap between grains of the lattice, as a fraction of the largest diameter.
constexpr double room = 0.02;

/// Returns `count` grains at the surface, the farthest from x first, then by id.
std::vector<Index> farthest_grains(const World& world, Index count, double x) {
  std::vector<Index> grains = surface_grains(world);
  if (grains.size() < static_cast<std::size_t>(count))
    throw Error(ExitCode::usage, "drop: {} grains, expected at most the {} at the free surface", count,
                grains.size());
  std::ranges::stable_sort(grains, std::ranges::greater(), [&](Index i) {
    return std::fabs(offset_along(world.boundary, x, world.grains.x[i]));
  });
  grains.resize(count);
  return grains;
}

struct Lattice {
  double cell = 0.0;  ///< m, side
  Index columns = 1;
  double centre = 0.0;  ///< m, along the bed
  double base = 0.0;    ///< m, above the floor

  double half_width() const { return 0.5 * cell * columns; }
};

/// Returns the highest point of the grains below a lattice that do not belong to it.
double highest_below(const World& world, const std::vector<bool>& lifted, const Lattice& lattice) {
  const Grains& grains = world.grains;
  double highest = 0.0;
  for (Index i = 0; i < grains.free_count; ++i) {
    const double distance = std::fabs(offset_along(world.boundary, lattice.centre, grains.x[i]));
    if (!lifted[i] && distance < lattice.half_width() + grains.radius[i])
      highest = std::max(highest, grains.y[i] + grains.radius[i]);
  }
  return highest;
}

Lattice lattice_at(const World& world, const std::vector<Index>& chosen, double x) {
  const Boundary& boundary = world.boundary;
  double largest = 0.0;
  for (const Index i : chosen) largest = std::max(largest, 2.0 * world.grains.radius[i]);
  Lattice lattice;
  lattice.cell = (1.0 + room) * largest;
  const auto side = static_cast<Index>(std::ceil(std::sqrt(static_cast<double>(chosen.size()))));
  const auto fitting = static_cast<Index>(boundary.length / lattice.cell);
  lattice.columns = std::max<Index>(1, std::min(side, fitting));
  const double half = lattice.half_width();
  lattice.centre = boundary.periodic ? x : std::max(half, std::min(x, boundary.length - half));
  return lattice;
}

/// Moves a grain to another position, at rest; by the shortest way in a periodic bed.
void place(World& world, Index i, Vec2 centre) {
  Grains& grains = world.grains;
  const double length = world.boundary.length;
  if (world.boundary.periodic) {
    const double way = offset_along(world.boundary, grains.x[i], centre.x);
    centre.x -= length * std::floor(centre.x / length);
    if (centre.x >= length) centre.x = 0.0;  // values just below 0 may round to the length
    grains.image[i] += static_cast<Index>(std::lround((grains.x[i] + way - centre.x) / length));
  }
  grains.x[i] = centre.x;
  grains.y[i] = centre.y;
  grains.vx[i] = grains.vy[i] = grains.omega[i] = 0.0;
}

void remove_contacts(Contacts& contacts, const std::vector<bool>& lifted) {
  const auto is_lifted = [&](Index body) {
    return static_cast<std::size_t>(body) < lifted.size() && lifted[body];
  };
  std::size_t kept = 0;
  for (std::size_t c = 0; c < contacts.a.size(); ++c) {
    if (is_lifted(contacts.a[c]) || is_lifted(contacts.b[c])) continue;
    contacts.a[kept] = contacts.a[c];
    contacts.b[kept] = contacts.b[c];
    contacts.shift[kept] = contacts.shift[c];
    for (auto* field : {&contacts.nx, &contacts.ny, &contacts.gap, &contacts.fn, &contacts.ft})
      (*field)[kept] = (*field)[c];
    if (!contacts.moment.empty()) contacts.moment[kept] = contacts.moment[c];
    ++kept;
  }
  contacts.resize(kept);
}

}  // namespace

std::vector<Index> surface_grains(const World& world) {
  const Grains& grains = world.grains;
  const std::vector<stress::SurfaceArc> surface = stress::free_surface(grains, world.boundary);
  std::vector<Index> found;
  for (Index i = 0; i < grains.free_count; ++i)
    if (grains.y[i] + grains.radius[i] >= stress::height_of(surface, grains.x[i])) found.push_back(i);
  return found;
}

void drop_grains(World& world, Index count, double x, double height) {
  const std::vector<Index> chosen = farthest_grains(world, count, x);
  std::vector<bool> lifted(world.grains.x.size(), false);
  for (const Index i : chosen) lifted[i] = true;
  Lattice lattice = lattice_at(world, chosen, x);
  lattice.base = highest_below(world, lifted, lattice) + height;
  const double left = lattice.centre - lattice.half_width();
  const std::size_t columns = lattice.columns;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const std::size_t column = k % columns, row = k / columns;
    place(world, chosen[k],
          {left + (static_cast<double>(column) + 0.5) * lattice.cell,
           lattice.base + (static_cast<double>(row) + 0.5) * lattice.cell});
  }
  remove_contacts(world.contacts, lifted);
}

}  // namespace talus::session
