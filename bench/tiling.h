#pragma once
/// A wide periodic bed from copies of a narrow one.

#include "core/world.h"

namespace talus::bench {

/// `copies` of a periodic world side by side, with the forces of its contacts. An equilibrium stays one.
/// Ids grow from the floor upwards as in a deposition of that width: a layer, taken as long as the floor, of
/// the first copy is followed by the same layer of the next.
/// Throws Error(internal) for a world with planes, which has no copies.
World tiled(const World& tile, Index copies);

}  // namespace talus::bench
