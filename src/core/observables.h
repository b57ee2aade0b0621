#pragma once
/// The scalar series of a run: names, units and meanings, for file, help and documentation.

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

// The trials of a run that is pushed on its way to failure (talus perturb), as stored in its file.

enum class TrialField { step, tilt, velocity, energy, end, time, moved, displacement };
inline constexpr std::size_t trial_field_count = 8;

inline constexpr std::array<SeriesField, trial_field_count> trial_fields = {{
    {"step", "1", "steps taken since the beginning of the run when a copy of the bed was pushed"},
    {"tilt", "deg", "tilt at which the copy was released, rounded to a step of the tilt"},
    {"velocity", "sqrt(g D)",
     "velocity that the push gives to the grains of a patch of the surface; 0: no push"},
    {"energy", "m g D", "kinetic energy that the push gives, m the mass of a disk of diameter D"},
    {"end", "1", "0 the copy came to rest, 1 it failed, 2 neither within the time of a trial"},
    {"time", "sqrt(D/g)", "time until the end of the trial"},
    {"moved", "1", "number of free grains whose centres moved by more than D during the trial"},
    {"displacement", "D", "mean displacement of the surface layer downslope"},
}};

using TrialRow = std::array<double, trial_field_count>;
inline double& at(TrialRow& row, TrialField field) { return row[static_cast<std::size_t>(field)]; }
inline double at(const TrialRow& row, TrialField field) { return row[static_cast<std::size_t>(field)]; }

}  // namespace talus
