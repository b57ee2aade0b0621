#pragma once
/// Progress on stderr: one line, rewritten in place on a terminal, printed at intervals in a log; and a
/// remark at the end of a run on steps that did not reach their tolerance.

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/types.h"
#include "session/run.h"
#include "session/session.h"

namespace talus::app {

/// Contents of a progress line.
struct Progress {
  std::string what;                 ///< "rendering 12/48"
  std::optional<double> share;      ///< fraction done; not shown if above 1
  double elapsed = 0.0;             ///< s
  std::optional<double> remaining;  ///< s
  /// Additional texts with ranks: if the line is too long, texts of the highest rank are omitted first. The
  /// bar has rank 4, the percentage 3, the elapsed time 2, the remaining time 1.
  std::vector<std::pair<std::string, int>> more = {};
};

/// Returns "rendering 12/48  [###-----------]  25 %  elapsed 10 s  ETA 30 s", cut to `width` columns, in
/// ASCII. Without a width, as in a log, the line is complete and has no bar.
std::string progress_text(const Progress& progress, std::optional<int> width);

/// Returns the progress of a count.
Progress count_progress(const std::string& label, std::size_t done, std::size_t count, double elapsed);

/// Displayed state of a run.
struct RunDisplay {
  session::Phase phase = session::Phase::deposition;
  double time = 0.0;                     ///< s, model time
  double tilt = 0.0;                     ///< deg
  std::optional<double> share;           ///< fraction of this phase done
  std::optional<double> repose_assumed;  ///< deg, angle of failure assumed for the fraction
  double residual = 0.0;
  double kinetic_energy = 0.0;  ///< J
  double velocity = 0.0;        ///< rms, over g h
  int contacts = 0;
};
Progress run_progress(const RunDisplay& shown, double elapsed, std::optional<double> remaining);

class StatusLine {
 public:
  /// Creates a line that is updated at most every `on_terminal` seconds on a terminal, or `in_log` seconds in
  /// a log. A quiet line shows nothing.
  StatusLine(bool quiet, double on_terminal, double in_log);
  /// Finishes the line, so that an error message starts on a new line.
  ~StatusLine() { finish(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Whether enough time has passed since the line was last shown or created; at the end of the work a
  /// terminal shows it in any case.
  bool is_due(bool at_end = false) const;
  void show(const Progress& progress);
  /// Seconds since the line was created.
  double elapsed() const { return std::chrono::duration<double>(Clock::now() - begun_).count(); }
  /// Ends the line and moves to the next.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_, terminal_;
  bool open_ = false;  ///< a line on the terminal is not ended yet
  std::chrono::duration<double> interval_;
  Clock::time_point begun_ = Clock::now(), shown_ = begun_;
};

/// Returns a function that shows a count on a separate line, from the first call on. Most calls do nothing,
/// because little time has passed since the last one.
CountDone count_shown(std::string label, bool quiet);

/// Returns a function that shows the state of a run in the same way; the line ends with its last copy.
std::function<void(const session::RunProgress&)> run_shown(bool quiet);

struct StepRemark {
  bool usual = true;  ///< false: the text is a warning
  std::string text;   ///< empty if all steps converged
};
/// Returns the remark on a run of `steps` steps in total.
StepRemark remark_on(const session::SolverRecord& record, std::int64_t steps);

}  // namespace talus::app
