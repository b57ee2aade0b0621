#pragma once
/// Repairing a run: a new one with all that is whole of a damaged one, which is left as it is.

#include <functional>
#include <string>
#include <vector>

#include "io/run_file.h"

namespace talus {

struct RepairRequest {
  std::string run;     ///< a packed file, or the folder of a run, by its name or that of its file
  std::string output;  ///< of the new run
  bool overwrite = false;
  /// The numbers of frames that cannot be, of a run of before schema version 3, whose frames no hash proves.
  std::function<std::vector<std::size_t>(const RunFile&)> faulty_frames;
};

struct RepairReport {
  bool was_whole = false;               ///< then nothing was written
  bool of_folder = false;               ///< of a run that was not complete
  bool goes_on = false;                 ///< the new run is a folder to be continued
  bool verified = true;                 ///< what was kept is proven to be as it was written
  std::vector<std::string> kept, lost;  ///< one line each
};

/// Throws Error(missing_input) where there is no such run, Error(bad_data) where nothing can be kept of it,
/// and Error(cannot_create) where the output exists already, or is the run itself.
RepairReport repair_run(const RepairRequest& request);

/// The pieces of a run that are not as they were written, one line each. HDF5 reads them in a process of its
/// own, so that the run may be damaged in any way. Throws Error(missing_input).
std::vector<std::string> damaged_pieces(const std::string& run);

}  // namespace talus
