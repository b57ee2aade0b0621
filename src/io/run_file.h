#pragma once
/// Reading a run, packed or still a folder, frame by frame in bounded memory.

#include <memory>
#include <string>
#include <vector>

#include "io/run_store.h"

namespace talus {

class RunFile {
 public:
  /// Opens `path`: a packed file, a folder `path.run/`, or such a folder by its own name.
  /// Throws Error(missing_input) or Error(bad_data) with the name of the data set that is wrong.
  static RunFile open(const std::string& path);

  RunFile(RunFile&&) noexcept;
  RunFile& operator=(RunFile&&) noexcept;
  ~RunFile();

  const RunHeader& header() const;
  bool complete() const;                           ///< false for the folder of an interrupted or running run
  std::size_t frame_count() const;
  const std::vector<double>& frame_tilts() const;  ///< rad, ascending
  /// Frame k with everything stored. Values are those of the file (single precision where it stores floats).
  Frame frame(std::size_t k) const;
  std::vector<ObservableRow> observables() const;
  std::vector<StepRow> steps() const;
  const Checkpoint& checkpoint() const;            ///< the last state, with results and timing

 private:
  struct State;
  explicit RunFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace talus
