#pragma once
/// A grain that a user pulls with a damped spring.

#include "core/drag_spring.h"
#include "core/world.h"
#include "session/schedule.h"

namespace talus::session {

/// From the centre of the grain to where the spring is held, m; the shortest way around a periodic bed.
Vec2 way_of_drag(const Drag& drag, const World& world);

/// m/s^2, what the spring adds to gravity at the centre of its grain: w^2 d - 2 w v, with the way d and the
/// velocity v of the grain: damped critically. w^2 = 10 g / D, but w h is at most a quarter: the force is
/// constant within a step (T4), which is stable and little damped otherwise then.
Vec2 drag_acceleration(const Drag& drag, double mean_diameter, double h, const World& world);

/// Gives the grain the velocity that the spring does in a step of length h, before the step is taken.
void pull(const Drag& drag, double mean_diameter, double h, World& world);

}  // namespace talus::session
