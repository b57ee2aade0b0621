#pragma once
/// The averages of an ensemble, from what its members have left beside their runs.

#include <string>

#include "app/ensemble_report.h"
#include "runs/run_view.h"

namespace talus {

/// Writes the tables of frames of a member beside its run: its series last, so that they are all there where
/// it is.
void write_tables(const std::string& run, const RunView& analysed);

/// Writes the numbers of a member, signed with the tables that are beside them, and returns them. From then
/// on the member is done.
MemberNumbers write_numbers(const Member& member, const RunView& analysed);

/// Writes members.csv, averages.csv and ensemble.h5 into the folder of an ensemble, of the members that are
/// done by then, and returns how far it was; writes nothing where none is done. One process at a time does:
/// the others wait, so that what is there is of the last look.
EnsembleView write_averages(const std::string& folder);

}  // namespace talus
