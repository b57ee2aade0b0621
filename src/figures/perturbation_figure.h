#pragma once
/// The figure of perturbed runs and their tables: the weakest push that starts an avalanche over the distance
/// to theta_c.

#include <span>
#include <string>

#include "figures/figure.h"
#include "figures/run_group.h"
#include "session/perturbation_table.h"

namespace talus::figures {

/// One row for each state of each run, in the order of the runs; `tables` has one table for each of them.
/// theta_c - theta is NaN where the slope has not failed.
Table perturbation_states(const RunGroup& group, std::span<const session::PerturbationTable> tables);

/// The figure "perturb", with this table as perturb.csv. Marks theta_d where runs have one, as the mean
/// distance to theta_c: by the jump of l_c max, and by the tilt from which on the volume strain is above its
/// minimum by more than its noise (a flat minimum itself is hardly known).
Figure perturbation_figure(const RunGroup& group, std::span<const session::PerturbationTable> tables);

/// Tables in Markdown: the thresholds by their distance to theta_c, and each state.
std::string perturbation_markdown(const RunGroup& group, std::span<const session::PerturbationTable> tables);

}  // namespace talus::figures
