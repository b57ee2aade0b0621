#pragma once
/// Repairs a run that was damaged at rest: copies every frame whose hash matches, and every other undamaged
/// part, into a new run.

#include <string>
#include <vector>

namespace talus::io {

struct RepairRequest {
  std::string run;     ///< a packed file, or the folder of a run, by its own name or that of its file
  std::string output;  ///< path of the new run, a packed file
  bool overwrite = false;
};

struct RepairReport {
  bool was_whole = false;               ///< whether the run was undamaged; nothing was written then
  bool of_folder = false;               ///< whether the run was a folder, that is, incomplete
  std::vector<std::string> kept, lost;  ///< one line each
};

/// Repairs a run. Throws Error(missing_input) if the run does not exist, Error(bad_data) if nothing can be
/// kept of it, and Error(cannot_create) if the output already exists or a process is writing the run.
RepairReport repair_run(const RepairRequest& request);

/// Returns the damaged pieces of a run, one line each. Throws Error(missing_input).
std::vector<std::string> damaged_pieces(const std::string& run);

}  // namespace talus::io
