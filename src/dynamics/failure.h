#pragma once
/// Rest and failure: the criteria by which a bed is at rest, and by which its slope has failed.

#include "core/world.h"

namespace talus::dynamics {

/// Number of successive steps in which the rms velocity must stay below a given fraction of g h (the velocity
/// that gravity gives a free grain in one step) for the bed to be at rest. A deposition then ends with a step
/// that reaches its tolerance.
inline constexpr int rest_steps = 50;

/// Returns the mean velocity along x, m/s, of the surface layer: the free grains whose centres lie above
/// `lower_edge` (m).
double surface_velocity(const Grains& grains, double lower_edge);

/// Depth of the surface layer below the mean free surface, in mean diameters.
inline constexpr double surface_layer_depth = 3.0;
/// Criteria of a surface flow and of failure.
struct FlowRule {
  double velocity = 0.0;  ///< m/s; the slope flows while its surface layer moves downslope faster than this
  double distance =
      0.0;  ///< m; a flow that carries the surface layer this far without a stop is a failure of the slope
};

/// Returns the flow rule: velocity 0.02 sqrt(g D), distance 5 D, or L/20 between walls if that is less,
/// because a flow between walls must end.
FlowRule flow_rule(double mean_diameter, double gravity, const Boundary& boundary);

/// The present surface flow, if any. It is part of the state of a run.
struct SurfaceFlow {
  bool flowing = false;
  double onset_tilt = 0.0;    ///< rad, tilt at which the flow began
  double displacement = 0.0;  ///< m, mean displacement of the surface layer since then
  bool failed = false;  ///< whether the slope has failed; onset_tilt is then the angle of repose theta_c
};

/// Updates the surface flow for one step of length h. A burst that stops is discarded. A sustained flow is a
/// failure, and the tilt at which it began is theta_c.
void follow_surface(SurfaceFlow& flow, double velocity, double tilt, double h, const FlowRule& rule);

}  // namespace talus::dynamics
