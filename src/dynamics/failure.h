#pragma once
/// Rest and failure: when a bed has come to rest, and when its slope has failed.

#include "core/world.h"

namespace talus::dynamics {

/// A bed is at rest when for this many steps in a row its rms velocity stayed below a stated fraction of g h
/// (the velocity that gravity gives a free grain within one step). A deposition ends there, with a step
/// solved to tolerance.
inline constexpr int rest_steps = 50;

/// Mean velocity along x of the surface layer: the free grains whose centre lies above `lower_edge` (m). m/s.
double surface_velocity(const Grains& grains, double lower_edge);

/// The surface layer reaches this many mean diameters below the mean free surface.
inline constexpr double surface_layer_depth = 3.0;
/// When a surface flow counts, and when it has failed the slope.
struct FlowRule {
  double velocity = 0.0;  ///< m/s: the slope flows while its surface layer moves downslope faster than this
  double distance =
      0.0;  ///< m: a flow that carried the surface layer this far without a stop has failed the slope
};

/// Velocity 0.02 sqrt(g D). Distance 5 D; between walls a flow must end, so there it is L/20 where that is
/// less.
FlowRule flow_rule(double mean_diameter, double gravity, const Boundary& boundary);

/// A surface flow that is under way, if any. A value: part of the state of a run.
struct SurfaceFlow {
  bool flowing = false;
  double onset_tilt = 0.0;    ///< rad, where it set in
  double displacement = 0.0;  ///< m, mean of the surface layer since then
  bool failed = false;        ///< it did not stop: onset_tilt is the angle of repose theta_c
};

/// Follows the surface for one step of length h. A burst that stops is forgotten; a flow that goes on is a
/// failure, and the angle at which it began is theta_c.
void follow_surface(SurfaceFlow& flow, double velocity, double tilt, double h, const FlowRule& rule);

}  // namespace talus::dynamics
