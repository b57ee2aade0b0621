#pragma once
/// The spring with which a user drags a grain.

namespace talus {

/// Stiffness of the spring, m g / D, with m the mass of the grain: extended by n D, it pulls with 10 n times
/// the weight of the grain.
inline constexpr double drag_stiffness = 10.0;
/// Largest extension of the spring, D.
inline constexpr double farthest_drag = 50.0;

}  // namespace talus
