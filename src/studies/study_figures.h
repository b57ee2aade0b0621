#pragma once
/// Results of a run that a study compares, read from its run file.

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "ensemble/member_values.h"
#include "io/run_file.h"

namespace talus::studies {

/// Results of one run: the failure of the slope, the state of the bed at the reference angle and at theta_c,
/// and the solution of the steps of the tilt.
enum class StudyQuantity : std::size_t {
  theta_c,
  volume_strain_at_reference,
  centre_of_mass_strain_at_reference,
  creep_at_reference,
  overloaded_fraction_at_reference,
  stress_ratio_at_reference,
  coordination_number_at_reference,
  volume_strain_at_theta_c,
  centre_of_mass_strain_at_theta_c,
  creep_at_theta_c,
  overloaded_fraction_at_theta_c,
  stress_ratio_at_theta_c,
  coordination_number_at_theta_c,
  residual_max_rest,
  residual_max_moving,
  unconverged_share,
  iterations_per_step,
  wall_seconds,
  count
};
inline constexpr std::size_t study_quantity_count = static_cast<std::size_t>(StudyQuantity::count);

/// Part of a study to which a result belongs.
enum class StudyGroup { slope, at_reference, at_theta_c, solver };

/// A result that a study compares.
struct StudyField {
  /// Name in CSV and JSON; the endings "_deg" and "_s" are units, other values are dimensionless.
  std::string name;
  std::string title;  ///< title in tables, with the unit
  StudyGroup group;
  double factor;  ///< factor from the value to the unit of tables
  std::string help;
};
/// Returns the fields in the order of StudyQuantity. Those in the table of quantities have the names and
/// definitions of that table.
const std::vector<StudyField>& study_fields();

/// One value for each quantity; NaN if a run has none.
using StudyFigures = std::array<double, study_quantity_count>;
inline double& at(StudyFigures& row, StudyQuantity q) { return row[static_cast<std::size_t>(q)]; }
inline double at(const StudyFigures& row, StudyQuantity q) { return row[static_cast<std::size_t>(q)]; }

/// Extent of a run.
struct RunReach {
  double theta_c = 0.0;  ///< deg; NaN if the slope has not failed
  double end = 0.0;      ///< last tilt, deg
};
/// Returns how far a run went.
RunReach reach(const io::RunFile& run);

/// Returns the results with the bed at `reference` deg and at theta_c, each from the last frame with a tilt
/// not above the angle; `member` contains the analysis of the run. Creep is the mean downslope displacement
/// of the free grains since the tilt began, over the nominal depth of the bed; it requires frames. A run that
/// failed before `reference`, or did not reach it, has no values there.
StudyFigures study_figures(const io::RunFile& run, const ensemble::MemberResult& member, double reference);

}  // namespace talus::studies
