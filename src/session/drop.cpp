/// Lifts grains from the free surface and drops them elsewhere.

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/errors.h"
#include "session/command.h"
#include "session/measure.h"
#include "stress/free_surface.h"

namespace talus::session {
namespace {

/// Gap between grains of the lattice, as a fraction of the largest diameter.
constexpr double room = 0.02;

/// Returns `count` grains at the surface, the farthest from x first; of equidistant grains, the smaller id
/// first.
std::vector<Index> farthest_grains(const World& world, Index count, double x) {
  std::vector<Index> grains = surface_grains(world);
  if (grains.size() < static_cast<std::size_t>(count))
    throw Error(ExitCode::usage, fmt::format("drop: {} grains, expected at most the {} at the free surface",
                                             count, grains.size()));
  std::ranges::stable_sort(grains, std::ranges::greater(), [&](Index i) {
    return std::fabs(offset_along(world.boundary, x, world.grains.x[i]));
  });
  grains.resize(static_cast<std::size_t>(count));
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
    if (!lifted[static_cast<std::size_t>(i)] && distance < lattice.half_width() + grains.radius[i])
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
    return static_cast<std::size_t>(body) < lifted.size() && lifted[static_cast<std::size_t>(body)];
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
  for (const Index i : chosen) lifted[static_cast<std::size_t>(i)] = true;
  Lattice lattice = lattice_at(world, chosen, x);
  lattice.base = highest_below(world, lifted, lattice) + height;
  const double left = lattice.centre - lattice.half_width();
  const auto columns = static_cast<std::size_t>(lattice.columns);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const std::size_t column = k % columns, row = k / columns;
    place(world, chosen[k],
          {left + (static_cast<double>(column) + 0.5) * lattice.cell,
           lattice.base + (static_cast<double>(row) + 0.5) * lattice.cell});
  }
  remove_contacts(world.contacts, lifted);
}

}  // namespace talus::session
