#pragma once
/// The figures of a run that a study compares, read from its run file.

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "ensemble/member_values.h"
#include "io/run_file.h"

namespace talus::studies {

/// What the figures of one run are: of the slope, of the bed at the reference angle and at theta_c, and of
/// how the steps of the tilt were solved.
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

enum class StudyGroup { slope, at_reference, at_theta_c, solver };

struct StudyField {
  std::string name;   ///< in CSV and JSON; "_deg" and "_s" at its end are units, all else are numbers
  std::string title;  ///< in tables, with the unit
  StudyGroup group;
  double factor;  ///< from the value to what tables show
  std::string help;
};
/// In the order of StudyQuantity. What the table of quantities has is called and explained as there.
const std::vector<StudyField>& study_fields();

/// One value for each quantity; NaN where a run has none.
using StudyFigures = std::array<double, study_quantity_count>;
inline double& at(StudyFigures& row, StudyQuantity q) { return row[static_cast<std::size_t>(q)]; }
inline double at(const StudyFigures& row, StudyQuantity q) { return row[static_cast<std::size_t>(q)]; }

/// How far a run went.
struct RunReach {
  double theta_c = 0.0;  ///< deg; NaN while the slope has not failed
  double end = 0.0;      ///< deg, the last tilt
};
RunReach reach(const io::RunFile& run);

/// The figures with the bed at `reference` deg, and at theta_c: each is that of the last frame with a tilt
/// not above the angle, `member` what the analysis of the run says of it. Creep is the mean displacement
/// downslope of the free grains since the tilt began, over the nominal depth of the bed; there is none of a
/// run without frames. A run that failed before `reference`, or did not reach it, has no values there.
StudyFigures study_figures(const io::RunFile& run, const ensemble::MemberResult& member, double reference);

}  // namespace talus::studies
