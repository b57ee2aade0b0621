#pragma once
/// Figure and tables of perturbed runs: the weakest push that starts an avalanche as a function of the
/// distance to theta_c.

#include <span>
#include <string>

#include "figures/figure.h"
#include "figures/run_group.h"
#include "session/perturbation_table.h"

namespace talus::figures {

/// Returns a table with one row for each state of each run, in the order of the runs; `tables` has one entry
/// for each run. theta_c - theta is NaN if the slope has not failed.
Table perturbation_states(const RunGroup& group, std::span<const session::PerturbationTable> tables);

/// Makes the figure "perturb", with this table as perturb.csv. It marks theta_d, if runs have one, as the
/// mean distance to theta_c: from the jump of l_c max, and from the tilt at which the volume strain exceeds
/// its minimum by more than the noise (the position of a flat minimum is poorly defined).
Figure perturbation_figure(const RunGroup& group, std::span<const session::PerturbationTable> tables);

/// Returns tables in Markdown: the thresholds by their distance to theta_c, and each state.
std::string perturbation_markdown(const RunGroup& group, std::span<const session::PerturbationTable> tables);

}  // namespace talus::figures
