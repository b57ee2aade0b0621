#pragma once
/// The analysis of a run as text.

#include <span>
#include <string>

#include "analysis/quantities.h"
#include "runs/run_view.h"

namespace talus::app {

/// Two tables: series at about ten angles, thresholds side by side, and theta_d by each estimator. Lengths in
/// mean diameters, angles in degrees.
std::string analysis_text(const runs::RunView& run);

/// What follows theta_c in a sentence where the bed was tilted on by more than a degree, to `tilt`, before
/// the flow that began there had failed the slope; else nothing. rad.
std::string beyond_repose(double theta_c, double tilt);

/// All scalars and series of the table under their names, in SI units, but not the values of single
/// grains; arrays in the shape of the table.
std::string analysis_json(const runs::RunView& run,
                          std::span<const analysis::Quantity> table = analysis::quantities());

}  // namespace talus::app
