#pragma once
/// The trials of a run that is pushed on its way to failure (talus perturb), as stored in its file.

#include <array>
#include <cstddef>

#include "core/observables.h"

namespace talus {

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
