#pragma once
/// A run that is about to be computed: begun, or taken up where its last commit left it.

#include <string>
#include <vector>

#include "session/run.h"

namespace talus::app {

/// What a command line asks for.
struct RunRequest {
  std::string scenario;               ///< its file
  std::string output;                 ///< the run file
  std::vector<std::string> settings;  ///< "key=value", the seed among them
  int threads = 1;
  bool overwrite = false;
  std::string command_line;  ///< for the provenance
  Facts facts = {};          ///< more of them, for the provenance of a new run
  std::string bed = {};      ///< hash that a bed of deposition.file has to have; empty: any
  std::string branch = {};   ///< run that this one begins with a frame of; empty: none
  std::string at = {};       ///< of a branch: the frame, as --at names it
};

struct OpenRun {
  io::RunHeader header;
  io::RunStore store;
  session::Session session;
};

/// A new run, its first state committed: from now on it can be resumed. Throws as read_scenario,
/// RunStore::create and RunStore::commit do, and Error(bad_data) where its bed is not the one asked for.
OpenRun start_run(const RunRequest& request);

/// A run that begins with a frame of another one, with the scenario of that run or, if one is given, another
/// that differs from it only in what begins to matter then: [contact], [solver], [output], [guards], where
/// the tilt ends, what follows failure, and commands that are still to come. Throws as start_run,
/// chosen_frames, session::checkpoint_at_frame, and Error(bad_data) where the scenario differs in something
/// else.
OpenRun start_branch(const RunRequest& request);

/// Throws Error(bad_data), with the keys that differ, where the file and the settings say another scenario
/// than the one stored with the run. No scenario file: nothing is asked.
void require_same_scenario(const RunRequest& request, const scenario::Scenario& stored);

/// The run whose folder is there. The scenario is the one stored with it (require_same_scenario).
/// Throws Error(bad_data) for a replay that was stopped before its end.
OpenRun resume_run(const RunRequest& request);

}  // namespace talus::app
