#pragma once
/// Runs about to be computed: started, or resumed from the last commit.

#include <string>
#include <vector>

#include "session/run.h"

namespace talus::app {

/// Run that a command line requests.
struct RunRequest {
  std::string scenario;               ///< scenario file
  std::string output;                 ///< run file
  std::vector<std::string> settings;  ///< "key=value", including the seed
  int threads = 1;
  bool overwrite = false;
  std::string command_line;  ///< for the provenance
  Facts facts = {};          ///< additional entries in the provenance of a new run
  std::string bed = {};      ///< required hash of the bed in deposition.file; empty: any
  std::string branch = {};   ///< run whose frame this run starts from; empty: none
  std::string at = {};       ///< frame of that run, in the syntax of --at
};

struct OpenRun {
  io::RunHeader header;
  io::RunStore store;
  session::Session session;
};

/// Creates a run and commits its first state, from which it can be resumed. Throws as read_scenario,
/// RunStore::create and RunStore::commit do, and Error(bad_data) if its bed is not the required one.
OpenRun start_run(const RunRequest& request);

/// Creates a run that starts from a frame of another run, with the scenario of that run or one that differs
/// only in settings that take effect later: [contact], [solver], [output], [guards], the end of the tilt, the
/// course after failure, and commands that are still due. Throws as start_run, chosen_frames and
/// session::checkpoint_at_frame do, and Error(bad_data) if the scenario differs in another respect.
OpenRun start_branch(const RunRequest& request);

/// Throws Error(bad_data), with the keys that differ, if file and settings describe another scenario than the
/// one stored with the run. Does nothing without a scenario file.
void require_same_scenario(const RunRequest& request, const scenario::Scenario& stored);

/// Resumes the run in an existing folder, with the scenario stored there (require_same_scenario). Throws
/// Error(bad_data) for a replay that was stopped before its end.
OpenRun resume_run(const RunRequest& request);

}  // namespace talus::app
