#include "tiling.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "base/errors.h"

namespace talus::bench {
namespace {

struct Ids {
  Index free_count, count, copies, layer;

  Index id(Index grain, Index copy) const {
    if (grain >= free_count) return in_block(free_count, count, grain, copy);
    const Index first = grain / layer * layer;
    return in_block(first, std::min(first + layer, free_count), grain, copy);
  }

 private:
  /// Returns the id of a grain in a copy of the block first ... last - 1; the copies of a block are
  /// consecutive.
  Index in_block(Index first, Index last, Index grain, Index copy) const {
    return first * copies + copy * (last - first) + grain - first;
  }
};

Grains tiled_grains(const Grains& from, const Ids& ids, double length) {
  Grains to;
  to.free_count = from.free_count * ids.copies;
  const auto spread = [&](auto Grains::*field) {
    (to.*field).resize((from.*field).size() * static_cast<std::size_t>(ids.copies));
    for (Index copy = 0; copy < ids.copies; ++copy)
      for (Index i = 0; i < from.count(); ++i) (to.*field)[ids.id(i, copy)] = (from.*field)[i];
  };
  for (auto field :
       {&Grains::x, &Grains::y, &Grains::vx, &Grains::vy, &Grains::omega, &Grains::radius,
        &Grains::inverse_mass, &Grains::inverse_inertia, &Grains::mass, &Grains::inertia, &Grains::angle})
    spread(field);
  spread(&Grains::image);
  for (Index copy = 0; copy < ids.copies; ++copy)
    for (Index i = 0; i < from.count(); ++i) to.x[ids.id(i, copy)] += copy * length;
  return to;
}

/// A contact of the wide bed and the original contact of the tile.
struct Copy {
  Index a, b;
  std::int8_t shift;
  Index original;
  bool reversed;  ///< the second body of the original is now the first

  auto key() const { return std::tuple(a, b, shift); }
};

Copy copy_of(const Contacts& contacts, Index c, Index copy, const Ids& ids) {
  const Index neighbour = copy + contacts.shift[c];
  const Index copy_b = (neighbour + ids.copies) % ids.copies;
  const auto shift = static_cast<std::int8_t>((neighbour - copy_b) / ids.copies);
  const Index a = ids.id(contacts.a[c], copy);
  const Index b = ids.id(contacts.b[c], copy_b);
  if (a < b) return {a, b, shift, c, false};
  return {b, a, static_cast<std::int8_t>(-shift), c, true};
}

Contacts tiled_contacts(const Contacts& from, const Ids& ids) {
  std::vector<Copy> copies;
  for (Index c = 0; c < from.count(); ++c)
    for (Index copy = 0; copy < ids.copies; ++copy) copies.push_back(copy_of(from, c, copy, ids));
  std::ranges::sort(copies, {}, &Copy::key);
  Contacts to;
  to.resize(copies.size());
  for (Index c = 0; c < to.count(); ++c) {
    const Copy& copy = copies[c];
    // Normal and force are reversed together, so the components f_n and f_t do not change.
    const double sign = copy.reversed ? -1.0 : 1.0;
    to.a[c] = copy.a;
    to.b[c] = copy.b;
    to.shift[c] = copy.shift;
    to.nx[c] = sign * from.nx[copy.original];
    to.ny[c] = sign * from.ny[copy.original];
    to.gap[c] = from.gap[copy.original];
    to.fn[c] = from.fn[copy.original];
    to.ft[c] = from.ft[copy.original];
  }
  return to;
}

}  // namespace

World tiled(const World& tile, Index copies) {
  if (!tile.boundary.periodic || !tile.boundary.planes.empty())
    throw Error(ExitCode::internal, "only a periodic bed on a rough floor can be tiled");
  const Index floor_count = tile.grains.count() - tile.grains.free_count;
  const Ids ids{tile.grains.free_count, tile.grains.count(), copies, floor_count};
  World world = tile;
  world.grains = tiled_grains(tile.grains, ids, tile.boundary.length);
  world.contacts = tiled_contacts(tile.contacts, ids);
  world.boundary.length = tile.boundary.length * copies;
  return world;
}

}  // namespace talus::bench
