#pragma once
/// The identity of a run: its difference from the run that its scenario alone gives.

#include <string>
#include <vector>

#include "io/run_file.h"
#include "scenario/scenario.h"

namespace talus::session {

/// Returns what was done to a run of this scenario that the scenario does not say, in order: the start as a
/// branch, and commands with the tilt and the time at which they were given, each drag once. Empty if `talus
/// run` makes the same run of the scenario. Runs that differ in it are neither members of one ensemble nor of
/// one group of a figure.
std::vector<std::string> departures(const io::RunFile& run, const scenario::Scenario& scenario);

/// Returns the first departures as a phrase: "friction 0.1 at 5.00 deg, 5.00 s and 2 more".
std::string departures_text(const std::vector<std::string>& departures);

}  // namespace talus::session
