#pragma once
/// Progress of a run on the line of a terminal, or now and then in a log.

#include "app/progress_text.h"
#include "app/status_line.h"
#include "session/run.h"

namespace talus {

class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  /// Shows where the run is. Most calls do nothing, since little time has passed since the last.
  void show(const RunProgress& progress);
  /// Leaves the line as it is and goes to the next.
  void finish() { line_.finish(); }

 private:
  RunShown shown(const RunProgress& progress);
  /// How far the phase is, in [0, 1] or above where it takes longer than expected; none where nothing is
  /// known.
  std::optional<double> share(const Session& session, RunShown& shown);

  StatusLine line_;
  std::optional<double> deposition_steps_;  ///< expected; 0: unknown
  std::optional<double> program_steps_;     ///< expected
  std::optional<Phase> phase_;
  double phase_began_ = 0.0;       ///< wall seconds when this process began the phase
  double phase_began_with_ = 0.0;  ///< share of the phase that was done by then
};

}  // namespace talus
