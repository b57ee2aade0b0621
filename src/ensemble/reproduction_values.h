#pragma once
/// What the members of a reproduction give, each by the analysis of its run file and by those of the
/// readings.

#include "ensemble/reproduction.h"

namespace talus {

/// Analyses the complete run of a periodic bed for each reading that its file does not hold, and keeps their
/// values beside it ("seed-1.readings/averaging=1.csv"); those that are there and valid are kept. A bed
/// between walls has none.
void make_readings(const Member& member);

/// Whether the run of a member is there, with its analysis and its readings, both of this version.
bool is_measured(const Member& member);

/// Reads what the members that are done give. Throws Error(bad_data) where the values of one are not there,
/// or not of this version.
ReproductionResult measure_members(const ReproductionPlan& plan);

}  // namespace talus
