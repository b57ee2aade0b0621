#pragma once
/// Wide periodic beds from copies of a narrow one.

#include "core/world.h"

namespace talus::bench {

/// Returns `copies` of a periodic world in a row, with the forces of its contacts, which stay in equilibrium.
/// Ids increase from the floor upwards as in a deposition of that width: a layer (with as many grains as the
/// floor) of the first copy is followed by the same layer of the next.
/// Throws Error(internal) for a world with planes, which cannot be copied.
World tiled(const World& tile, Index copies);

}  // namespace talus::bench
