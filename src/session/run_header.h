#pragma once
/// Header of a run at its start.

#include <optional>
#include <string>

#include "runs/run_view.h"
#include "session/session.h"

namespace talus::session {

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
