#pragma once
/// One seed of `talus perturb`: its run, stepped as `talus run` does, and the trials on copies of it.

#include <string>

#include "app/open_run.h"
#include "session/perturbation_table.h"

namespace talus {

/// A run of one seed with its table beside it.
std::string perturbation_table_path(const std::string& run);

/// The table of a run. Throws as read_file and parse_perturbation_csv do.
PerturbationTable read_perturbation_table(const std::string& run, const PerturbationPlan& plan);

/// Whether run and table are there and complete. Throws Error(bad_data) where what is there is that of
/// another scenario or plan, or the table of a run is missing.
bool is_perturbed(const RunRequest& request, const PerturbationPlan& plan);

/// Computes the run of the request and its table, or goes on with them, and says on stderr what was found at
/// each state. The table is written after each state, before the run commits what comes after it, so that
/// neither is ever ahead of what it needs. Throws Error(stopped) on SIGINT and SIGTERM, and as start_run and
/// resume_run do.
void perturb_seed(const RunRequest& request, const PerturbationPlan& plan);

}  // namespace talus
