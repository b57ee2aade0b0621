#pragma once
/// Quantities that a run records of its world.

#include "core/snapshot.h"
#include "dynamics/contact_law_parameters.h"
#include "dynamics/step.h"

namespace talus::session {

/// Reference of strains: the bed at rest before the tilt.
struct Baseline {
  double volume = 0.0;                 ///< V0, m^2
  double centre_of_mass_height = 0.0;  ///< y0, m
};
/// Returns the baseline of a bed, which is 0 without free grains.
Baseline measure_baseline(const World& world);

/// Inputs of a row of observables in addition to the world.
struct RowContext {
  Baseline baseline;
  dynamics::ContactLawParameters law;
  double mean_diameter = 0.0;         ///< m
  double surface_displacement = 0.0;  ///< m
  double largest_overlap = 0.0;       ///< m, of the last step
  double residual = 0.0;              ///< largest eta since the last row, that of the last step included
  bool at_rest = false;
};
/// Returns a row of the observables (core/observables.h), in SI units and per metre of thickness. Compression
/// is positive, and so is a shear stress due to gravity towards +x.
ObservableRow measure(const World& world, const RowContext& context);

/// Returns a row of the series of steps.
StepRow step_row(const World& world, const dynamics::StepReport& report, double phase);

/// Returns a frame: a copy of the state with grain stresses and the contacts that carry force.
Frame make_frame(const World& world, const dynamics::ContactLawParameters& law);

}  // namespace talus::session
