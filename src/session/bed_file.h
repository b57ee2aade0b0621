#pragma once
/// Deposition from a file: a bed as a frame of a run or a table has it.

#include <cstddef>
#include <string>

#include "dynamics/bed.h"
#include "scenario/scenario.h"

namespace talus::session {

/// Overlaps up to this are taken back by the steps that bring the bed to rest, D.
inline constexpr double largest_file_overlap = 0.01;
/// How far the mean diameter of the grains may be from that of the plan, as a share of it.
inline constexpr double mean_diameter_tolerance = 0.1;

/// The bed of a plan with the grains of a file, at rest and without contact forces: those of frame `frame` of
/// a run, or of a table (bed_table.h) with lengths in `unit`, of which `frame` is 0. Floor and walls are
/// those of the plan. Throws Error(missing_input) where there is no such file, and Error(bad_data) with the
/// place where it cannot be read, or where it does not fit the plan: another period, boundary or mean
/// diameter, overlaps, grains outside.
World bed_of_file(const std::string& path, std::size_t frame, const dynamics::BedPlan& plan,
                  scenario::LengthUnit unit = scenario::LengthUnit::mean_diameter);

}  // namespace talus::session
