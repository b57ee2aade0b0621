#pragma once
/// What is known of a run when it begins.

#include <optional>
#include <string>

#include "runs/run_view.h"
#include "session/session.h"

namespace talus::session {

/// Where a run comes from, for its provenance.
struct RunOrigin {
  std::string scenario_text;  ///< TOML as the user wrote it
  std::string scenario_file;
  std::string command_line;
  int threads = 1;
  std::optional<io::BranchOrigin> branch{};
  std::string bed{};  ///< hash of a bed that came from a file (with_bed)
};

/// The origin of a run whose session stands at its start, with the hash of its bed where deposition.file
/// holds that: a file may be changed while the scenario stays.
RunOrigin with_bed(RunOrigin origin, const Session& at_start);

/// The hash that with_bed noted, from the provenance of a run; empty where there is none.
std::string bed_of(const Facts& provenance);

/// The header of a run that this program begins now, on this host.
io::RunHeader run_header(const Session& session, const RunOrigin& origin);

/// Throws Error(bad_data) where the run is a replay that was stopped: what goes on from there lacks the
/// commands that were still to come.
void refuse_unfinished_replay(const io::RunHeader& header, const World& world, const std::string& path);

/// The session of a stored run before its first step; of a branch, with what it records of its start. `name`
/// is what messages call the file. Throws Error(bad_data) as stored_scenario and check_branch_start do, and
/// where deposition.file now holds another bed.
Session session_at_start(const io::RunHeader& header, const std::string& name);

}  // namespace talus::session
