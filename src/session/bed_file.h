#pragma once
/// Deposition from a file: a bed as a frame of a run or a table has it.

#include <string>

#include "dynamics/bed.h"
#include "scenario/scenario.h"

namespace talus::session {

/// Overlaps up to this are taken back by the steps that bring the bed to rest, D.
inline constexpr double largest_file_overlap = 0.01;
/// The same where overlaps are pushed apart before, and what is left of them then.
inline constexpr double largest_soft_overlap = 0.1, relaxed_overlap = 0.001;
/// How far the mean diameter of the grains may be from that of the plan, as a share of it.
inline constexpr double mean_diameter_tolerance = 0.1;

struct BedFile {
  std::string path;
  int frame = 0;  ///< from 0; -1: the last
  scenario::LengthUnit unit = scenario::LengthUnit::mean_diameter;
  double scale = 1.0;
  bool relax = false;  ///< whether overlaps are pushed apart (dynamics/push_apart.h)
};

/// The bed of a plan with the grains of a file, at rest and without contact forces: those of a frame of a
/// run, or of a table or dump (bed_table.h). Grains of these whose tops are at y = 0 are another floor, and
/// left out. Floor and walls are those of the plan. `remark` becomes what there is to say of it: what was
/// left out, how far grains were moved. Throws Error(missing_input) where there is no such file, and
/// Error(bad_data) with the place where it cannot be read, or where it does not fit the plan: another period,
/// boundary or mean diameter, overlaps, grains outside.
World bed_of_file(const BedFile& file, const dynamics::BedPlan& plan, std::string* remark = nullptr);

}  // namespace talus::session
