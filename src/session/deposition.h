#pragma once
/// Initial bed of a scenario, and the grains that arrive later.

#include <string>
#include <vector>

#include "dynamics/bed.h"
#include "scenario/scenario.h"

namespace talus::session {

using scenario::LengthUnit;
using scenario::Scenario;

// Deposition from a file: a bed from a frame of a run, or from a table.

/// Largest overlap accepted, D; the steps that bring the bed to rest remove it.
inline constexpr double largest_file_overlap = 0.01;
/// Largest overlap accepted if overlaps are pushed apart first, and the overlap left afterwards, D.
inline constexpr double largest_soft_overlap = 0.1, relaxed_overlap = 0.001;
/// Largest relative deviation of the mean diameter of the grains from that of the plan.
inline constexpr double mean_diameter_tolerance = 0.1;

struct BedFile {
  std::string path;
  int frame = 0;  ///< counted from 0; -1: the last
  LengthUnit unit = LengthUnit::mean_diameter;
  double scale = 1.0;
  bool relax = false;  ///< whether overlaps are pushed apart (dynamics/bed.h)
  double depth = 1.0;  ///< nominal depth of the bed, m
};

/// Returns the bed of a plan with the grains of a file, at rest and without contact forces: those of a frame
/// of a run, or of a table or dump (bed_table.h). Grains of a table or dump whose tops are at y = 0 belong to
/// another floor and are left out. Floor and walls are those of the plan. `remark` receives notes on what was
/// left out and how far grains were moved. Throws Error(missing_input) if the file does not exist, and
/// Error(bad_data) with the position if it cannot be read or does not fit the plan: another period, boundary
/// or mean diameter, overlaps, grains outside, or grains that no run can store (io/run_store.h).
World bed_of_file(const BedFile& file, const dynamics::BedPlan& plan, std::string* remark = nullptr);

/// Returns the bed before its first step: all grains, or none if they are poured, above or on the floor.
/// Grains from a file: throws as bed_of_file does, and `remark` receives its remark.
World initial_bed(const Scenario& scenario, std::string* remark = nullptr);

/// Returns the hash of the initial bed that a scenario takes from a file; empty for other methods. Throws as
/// bed_of_file does.
std::string bed_hash(const Scenario& scenario);

/// Returns walls and smooth floor of the bed, which do not change.
Boundary boundary_of(const Scenario& scenario);

/// Returns the final number of grains in the bed. Reads and checks a file, and throws as bed_of_file does.
Index grain_count(const Scenario& scenario);

/// Returns the poured grains in the order of their arrival; none for other methods.
std::vector<dynamics::Arrival> arrivals_of(const Scenario& scenario);

/// Returns the rule of their arrival, in SI units.
dynamics::PourRule pour_rule(const Scenario& scenario);

/// Returns the time of the last arrival, s; 0 if all grains are present from the start.
double end_of_arrivals(const Scenario& scenario);

/// Returns advice for a bed that did not come to rest in time, with the key for it; `velocity` in g h.
std::string advice_for_rest(const Scenario& scenario, double velocity);

}  // namespace talus::session
