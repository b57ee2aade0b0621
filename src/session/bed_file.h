#pragma once
/// Deposition from a file: a bed from a frame of a run, or from a table.

#include <string>

#include "dynamics/bed.h"
#include "scenario/scenario.h"

namespace talus::session {

/// Largest overlap accepted, D; the steps that bring the bed to rest remove it.
inline constexpr double largest_file_overlap = 0.01;
/// Largest overlap accepted if overlaps are pushed apart first, and the overlap left afterwards, D.
inline constexpr double largest_soft_overlap = 0.1, relaxed_overlap = 0.001;
/// Largest relative deviation of the mean diameter of the grains from that of the plan.
inline constexpr double mean_diameter_tolerance = 0.1;

struct BedFile {
  std::string path;
  int frame = 0;  ///< counted from 0; -1: the last
  scenario::LengthUnit unit = scenario::LengthUnit::mean_diameter;
  double scale = 1.0;
  bool relax = false;  ///< whether overlaps are pushed apart (dynamics/push_apart.h)
  double depth = 1.0;  ///< nominal depth of the bed, m
};

/// Returns the bed of a plan with the grains of a file, at rest and without contact forces: those of a frame
/// of a run, or of a table or dump (bed_table.h). Grains of a table or dump whose tops are at y = 0 belong to
/// another floor and are left out. Floor and walls are those of the plan. `remark` receives notes on what was
/// left out and how far grains were moved. Throws Error(missing_input) if the file does not exist, and
/// Error(bad_data) with the position if it cannot be read or does not fit the plan: another period, boundary
/// or mean diameter, overlaps, grains outside, or grains that no run can store (io/bounds.h).
World bed_of_file(const BedFile& file, const dynamics::BedPlan& plan, std::string* remark = nullptr);

}  // namespace talus::session
