#pragma once
/// What perturbed runs say, as text.

#include <span>
#include <string>

#include "figures/run_group.h"
#include "session/perturbation_table.h"

namespace talus {

/// Tables in Markdown: the thresholds by their distance to theta_c, and each state. `tables` has one table
/// for each run of the group.
std::string perturbation_markdown(const RunGroup& group, std::span<const PerturbationTable> tables);

}  // namespace talus
