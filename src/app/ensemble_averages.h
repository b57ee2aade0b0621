#pragma once
/// The averages of an ensemble, from what its members have left beside their runs.

#include "app/ensemble_report.h"
#include "ensemble/member_series.h"

namespace talus {

/// The series of a member that is done: read from the table beside its run, or made from the run and its
/// analysis where there is none, and kept. Throws Error(bad_data) where the table has been changed, and as
/// analysed_run does.
MemberSeries series_of_member(const Member& member);

/// Writes members.csv, averages.csv and ensemble.h5 into the folder of the ensemble, of the members that are
/// done; nothing where none is.
void write_averages(const EnsembleView& view);

}  // namespace talus
