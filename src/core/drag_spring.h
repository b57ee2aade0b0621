#pragma once
/// The spring by which a user drags a grain.

namespace talus {

/// Stiffness of the spring, m g / D, m the mass of the grain: held so many D away it pulls with ten times
/// that many weights of the grain.
inline constexpr double drag_stiffness = 10.0;
/// D; a spring is held within this distance of its grain.
inline constexpr double farthest_drag = 50.0;

}  // namespace talus
