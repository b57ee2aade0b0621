#pragma once
/// Measurement of the members of a reproduction, by their stored analyses and by those of the readings.

#include "io/run_file.h"
#include "runs/analysis_run.h"
#include "studies/reproduction.h"

namespace talus::studies {

/// Analyses the run of a periodic bed for each reading and returns the values; valid stored readings are
/// reused. A bed between walls has none. Throws as analyse_run does.
std::vector<io::StoredReading> make_readings(const ensemble::Member& member, const io::RunFile& run,
                                             const runs::AnalysisProgress& progress);

/// Computes and stores the readings that the complete run of a member lacks. Throws as store_readings does.
void complete_readings(const ensemble::Member& member);

/// Whether the run of a member exists, with an analysis and readings of this version.
bool is_measured(const ensemble::Member& member);

/// Reads the values of the complete members. Throws Error(bad_data) if those of one are missing or of another
/// version.
ReproductionResult measure_members(const ReproductionPlan& plan);

}  // namespace talus::studies
