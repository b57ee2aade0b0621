#pragma once
/// The identity of a run: its difference from the run that its scenario alone gives.

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "io/run_file.h"
#include "scenario/scenario.h"

namespace talus::session {

/// Returns what was done to a run of this scenario, before a step, that the scenario does not say, in order:
/// the start as a branch with the history of the run it left, and commands with the tilt and the time at
/// which they were given. Empty if `talus run` makes the same run of the scenario. Runs that differ in it are
/// neither members of one ensemble nor of one group of a figure.
std::vector<std::string> departures(const io::RunFile& run, const scenario::Scenario& scenario,
                                    std::int64_t step = std::numeric_limits<std::int64_t>::max());

/// Returns the departure that is a command given at a tilt (deg; NaN in the deposition), `time` s after the
/// tilt began.
std::string departure_text(const Command& command, double tilt, double time);

/// Returns departures in the form in which a branch stores them; a hash represents many.
std::string history_text(const std::vector<std::string>& departures);

/// Returns the first departures as a phrase: "friction 0.1 at 5.00 deg, 5.00 s and 2 more".
std::string departures_text(const std::vector<std::string>& departures);

}  // namespace talus::session
