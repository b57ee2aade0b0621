#pragma once
/// What the members of a reproduction give, each by the analysis of its run file and by those of the
/// readings.

#include "io/run_file.h"
#include "runs/analysis_run.h"
#include "studies/reproduction.h"

namespace talus::studies {

/// Analyses the run of a periodic bed for each reading, and returns what they give; those that are stored
/// with it and valid are taken as they are. A bed between walls has none. Throws as analyse_run does.
std::vector<io::StoredReading> make_readings(const ensemble::Member& member, const io::RunFile& run,
                                             const runs::AnalysisProgress& progress);

/// Stores with the complete run of a member what it lacks of them. Throws as store_readings does.
void complete_readings(const ensemble::Member& member);

/// Whether the run of a member is there, with its analysis and its readings, both of this version.
bool is_measured(const ensemble::Member& member);

/// Reads what the members that are done give. Throws Error(bad_data) where the values of one are not there,
/// or not of this version.
ReproductionResult measure_members(const ReproductionPlan& plan);

}  // namespace talus::studies
