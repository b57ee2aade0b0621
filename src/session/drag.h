#pragma once
/// Drag of a grain by a user with a damped spring.

#include "core/drag_spring.h"
#include "core/world.h"
#include "session/schedule.h"

namespace talus::session {

/// Returns the vector from the centre of the grain to the point where the spring is held, m; the shortest one
/// in a periodic bed.
Vec2 drag_offset(const Drag& drag, const World& world);

/// Returns the acceleration (m/s^2) that the spring adds to gravity at the centre of its grain, w^2 d - 2 w
/// v, with the vector d and the velocity v of the grain, which is critical damping. w^2 = 10 g / D, but w h
/// is limited to a quarter, because the force is constant within a step (T4), which is unstable or weakly
/// damped for larger w h.
Vec2 drag_acceleration(const Drag& drag, double mean_diameter, double h, const World& world);

/// Adds the velocity that the spring gives the grain in a step of length h, before the step is taken.
void pull(const Drag& drag, double mean_diameter, double h, World& world);

}  // namespace talus::session
