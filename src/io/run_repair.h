#pragma once
/// Repairing a run that was damaged at rest: every frame whose hash holds, and every other part that is as it
/// was written, is copied into a new run.

#include <string>
#include <vector>

namespace talus::io {

struct RepairRequest {
  std::string run;     ///< a packed file, or the folder of a run, by its name or that of its file
  std::string output;  ///< of the new run, a packed file
  bool overwrite = false;
};

struct RepairReport {
  bool was_whole = false;               ///< then nothing was written
  bool of_folder = false;               ///< of a run that was not complete
  std::vector<std::string> kept, lost;  ///< one line each
};

/// Throws Error(missing_input) where there is no such run, Error(bad_data) where nothing can be kept of it,
/// and Error(cannot_create) where the output exists already, or a process is writing the run.
RepairReport repair_run(const RepairRequest& request);

/// What of a damaged run is not as it was written, one line each. Throws Error(missing_input).
std::vector<std::string> damaged_pieces(const std::string& run);

}  // namespace talus::io
