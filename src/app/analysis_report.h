#pragma once
/// Text and JSON reports of the analysis of a run.

#include <span>
#include <string>

#include "analysis/quantities.h"
#include "runs/run_view.h"

namespace talus::app {

/// Returns two tables: series at about ten angles with all thresholds in columns, and theta_d by each
/// estimator. Lengths are in mean diameters, angles in degrees.
std::string analysis_text(const runs::RunView& run);

/// Returns lines on the distributions of events: count, sizes, waiting angles, fraction that dilates the bed;
/// or the reason why a number is missing.
std::string event_summary(const runs::RunView& run);

/// Returns a clause to append to a statement of theta_c (rad) if tilting continued to `tilt` (rad), more than
/// a degree beyond theta_c, before the flow had failed the slope; else an empty text.
std::string beyond_repose(double theta_c, double tilt);

/// Returns all scalars and series of the table by name, in SI units, without the values of single grains;
/// arrays have the shape that the table states.
std::string analysis_json(const runs::RunView& run,
                          std::span<const analysis::Quantity> table = analysis::quantities());

}  // namespace talus::app
