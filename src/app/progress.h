#pragma once
/// Progress of a run: one line that is rewritten on a terminal, plain lines now and then in a log.

#include "app/progress_text.h"
#include "session/run.h"

namespace talus {

class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  /// Shows where the run is; most calls do nothing, as time since the last line is short.
  void show(const RunProgress& progress);
  /// Leaves the line as it is and goes to the next.
  void finish();

 private:
  RunShown shown(const RunProgress& progress);

  bool quiet_;
  bool terminal_;
  bool open_ = false;
  double last_shown_ = -1e9;
  double tilt_started_at_ = -1.0;   ///< wall seconds when this process began to tilt
  double tilt_started_from_ = 0.0;  ///< deg
};

}  // namespace talus
