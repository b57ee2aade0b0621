#include "dynamics/push_apart.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact/detection.h"

namespace talus::dynamics {
namespace {

constexpr int rounds = 2000;  // each with another detection of contacts
constexpr int sweeps_in_a_round = 10;
constexpr double margin_over_radius = 0.05;  // gap of pairs that may begin to overlap in a round

/// Makes one round: moves grains by their overlaps, and returns the deepest overlap before the round.
double push_overlaps(World& world, const Contacts& contacts, double allowed, std::vector<Vec2>& moved) {
  if (contacts.gap.empty()) return 0.0;
  const double deepest = -std::ranges::min(contacts.gap);
  if (deepest <= allowed) return deepest;
  Grains& grains = world.grains;
  std::vector<Vec2> way(static_cast<std::size_t>(grains.count()) + world.boundary.planes.size());
  for (int sweep = 0; sweep < sweeps_in_a_round; ++sweep)
    for (std::size_t c = 0; c < contacts.a.size(); ++c) {
      Vec2 &a = way[static_cast<std::size_t>(contacts.a[c])],
           &b = way[static_cast<std::size_t>(contacts.b[c])];
      const double nx = contacts.nx[c], ny = contacts.ny[c];
      const double overlap = -(contacts.gap[c] + nx * (b.x - a.x) + ny * (b.y - a.y));
      if (overlap <= 0.0) continue;
      const double share = contacts.b[c] < grains.free_count ? 0.5 * overlap : overlap;
      a = {a.x - share * nx, a.y - share * ny};
      if (contacts.b[c] < grains.free_count) b = {b.x + share * nx, b.y + share * ny};
    }
  for (Index i = 0; i < grains.free_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    moved[k] = {moved[k].x + way[k].x, moved[k].y + way[k].y};
    grains.x[i] += way[k].x;
    grains.y[i] += way[k].y;
    const double length = world.boundary.length;
    if (world.boundary.periodic) grains.x[i] -= length * std::floor(grains.x[i] / length);
    if (world.boundary.periodic && grains.x[i] >= length)
      grains.x[i] = 0.0;  // a value just below 0 was rounded up to the period
  }
  return deepest;
}

}  // namespace

Displacement push_apart(World& world, double allowed) {
  std::vector<Vec2> moved(static_cast<std::size_t>(world.grains.free_count));
  if (moved.empty()) return {};
  const double margin = margin_over_radius * std::ranges::max(world.grains.radius);
  contact::NeighbourList list;
  Contacts contacts;
  for (int round = 0; round < rounds; ++round) {
    contact::detect_contacts(list, world.grains, world.boundary, margin, contacts);
    if (push_overlaps(world, contacts, allowed, moved) <= allowed) break;
  }
  Displacement displacement;
  for (const Vec2 way : moved) {
    const double distance = std::sqrt(way.x * way.x + way.y * way.y);
    displacement.mean += distance / static_cast<double>(moved.size());
    displacement.largest = std::max(displacement.largest, distance);
  }
  return displacement;
}

}  // namespace talus::dynamics
