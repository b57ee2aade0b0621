#pragma once
/// The averages of an ensemble, from the runs of its members.

#include <string>

#include "app/ensemble_report.h"

namespace talus::app {

/// Writes members.csv, averages.csv and ensemble.h5 into the folder of an ensemble, of the members that are
/// done by then, and returns how far it was; writes nothing where none is done. Runs that are not analysed
/// yet are. One process at a time does: the others wait, so that what is there is of the last look. Throws as
/// read_ensemble and analysed_member do.
EnsembleView write_averages(const std::string& folder, ensemble::KnownMembers& known);

}  // namespace talus::app
