#pragma once
/// The scalar series of a run: names, units and meanings in one place, so that file, help and documentation
/// agree.

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace talus {

struct SeriesField {
  std::string_view name;
  std::string_view unit;  ///< SI, or "1"
  std::string_view help;
};

/// Scalars of the bed, sampled every output.observable_every degrees of tilt.
enum class Observable : std::size_t {
  step,
  time,
  tilt,
  sigma_n,
  sigma_t,
  sigma_t_over_n,
  stress_ratio,
  solid_fraction,
  coordination_number,
  critical_fraction,
  volume_strain,
  centre_of_mass_strain,
  surface_displacement,
  kinetic_energy,
  rms_velocity,
  largest_overlap,
  residual,
  at_rest,
  count
};
inline constexpr std::size_t observable_count = static_cast<std::size_t>(Observable::count);
extern const std::array<SeriesField, observable_count> observable_fields;

/// Scalars of each step, deposition included: the quality of its solution.
enum class StepField : std::size_t {
  step,
  phase,
  contacts,
  iterations,
  residual,
  converged,
  rms_velocity,
  count
};
inline constexpr std::size_t step_field_count = static_cast<std::size_t>(StepField::count);
extern const std::array<SeriesField, step_field_count> step_fields;

using ObservableRow = std::array<double, observable_count>;
using StepRow = std::array<double, step_field_count>;

inline double& at(ObservableRow& row, Observable field) { return row[static_cast<std::size_t>(field)]; }
inline double at(const ObservableRow& row, Observable field) { return row[static_cast<std::size_t>(field)]; }
inline double& at(StepRow& row, StepField field) { return row[static_cast<std::size_t>(field)]; }
inline double at(const StepRow& row, StepField field) { return row[static_cast<std::size_t>(field)]; }

}  // namespace talus
