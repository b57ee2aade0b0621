#pragma once
/// Header of a run at its start, and the difference of a run from the one that its scenario alone gives.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "io/run_file.h"
#include "runs/run_view.h"
#include "scenario/scenario.h"
#include "session/session.h"

namespace talus::session {

using scenario::Scenario;

// The identity of a run: its difference from the run that its scenario alone gives.

/// Returns what was done to a run of this scenario, before a step, that the scenario does not say, in order:
/// the start as a branch with the history of the run it left, and commands with the tilt and the time at
/// which they were given. Empty if `talus run` makes the same run of the scenario. Runs that differ in it are
/// neither members of one ensemble nor of one group of a figure.
std::vector<std::string> departures(const io::RunFile& run, const Scenario& scenario,
                                    std::int64_t step = std::numeric_limits<std::int64_t>::max());

/// Returns the departure that is a command given at a tilt (deg; NaN in the deposition), `time` s after the
/// tilt began.
std::string departure_text(const Command& command, double tilt, double time);

/// Returns departures in the form in which a branch stores them; a hash represents many.
std::string history_text(const std::vector<std::string>& departures);

/// Returns the first departures as a phrase: "friction 0.1 at 5.00 deg, 5.00 s and 2 more".
std::string departures_text(const std::vector<std::string>& departures);

/// Origin of a run, for its provenance.
struct RunOrigin {
  std::string scenario_text;  ///< TOML as the user wrote it
  std::string scenario_file;
  std::string command_line;
  int threads = 1;
  std::optional<io::BranchOrigin> branch{};
  std::string bed{};  ///< hash of a bed from a file (with_bed)
};

/// Adds the hash of the bed to the origin of a run whose session is at its start, if deposition.file provides
/// the bed, because the file may change while the scenario does not.
RunOrigin with_bed(RunOrigin origin, const Session& at_start);

/// Returns the hash that with_bed stored in the provenance of a run; empty if there is none.
std::string bed_of(const Facts& provenance);

/// Returns the header of a run that this process starts, on this host.
io::RunHeader run_header(const Session& session, const RunOrigin& origin);

/// Throws Error(bad_data) if the run is a replay that was stopped, because a continuation would lack the
/// remaining commands.
void refuse_unfinished_replay(const io::RunHeader& header, const World& world, const std::string& path);

/// Returns the session of a stored run before its first step; for a branch, with the row and frame of its
/// start recorded. `name` denotes the file in messages. Throws Error(bad_data) as stored_scenario and
/// check_branch_start do, and if deposition.file holds another bed than at the start of the run.
Session session_at_start(const io::RunHeader& header, const std::string& name);

}  // namespace talus::session
