#pragma once
/// Averages of an ensemble, computed from the runs of its members.

#include <string>

#include "app/ensemble_report.h"

namespace talus::app {

/// Writes members.csv, averages.csv and ensemble.h5 for the members that are done into the folder of the
/// ensemble, and returns its progress; writes nothing if no member is done. Runs without an analysis are
/// analysed. Processes take turns, so that the files reflect the latest state. Throws as read_ensemble and
/// analysed_member do.
EnsembleView write_averages(const std::string& folder, ensemble::KnownMembers& known);

}  // namespace talus::app
