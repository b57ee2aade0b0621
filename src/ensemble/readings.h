#pragma once
/// Further analyses of the periodic beds of `talus reproduce`, each with other parameters, of which the run
/// file keeps the values of the paper's chain (docs/reproduce.md). The module talus.paper of the Python
/// package reads them.

#include "ensemble/plan.h"
#include "io/run_file.h"
#include "io/run_store.h"
#include "runs/analysis_run.h"

namespace talus::ensemble {

/// Analyses the run of a periodic bed for each reading and returns the values; valid stored readings are
/// reused. A bed between walls has none. Throws as analyse_run does.
std::vector<io::StoredReading> make_readings(const Member& member, const io::RunFile& run,
                                             const runs::AnalysisProgress& progress);

/// Computes and stores the readings that the complete, analysed run of a member lacks. Throws as
/// store_readings does.
void complete_readings(const Member& member);

}  // namespace talus::ensemble
