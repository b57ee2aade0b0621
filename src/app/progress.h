#pragma once
/// Progress on stderr: one line, rewritten in place on a terminal, written now and then in a log.

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/watch.h"
#include "session/run.h"

namespace talus::app {

/// What a line of progress says.
struct Progress {
  std::string what;                 ///< "rendering 12/48"
  std::optional<double> share;      ///< that is done; beyond 1 it promises nothing, and is not shown
  double elapsed = 0.0;             ///< s
  std::optional<double> remaining;  ///< s
  /// Texts with ranks: where the line is too long, those of the highest rank are left out first. The bar has
  /// rank 4, the percentage 3, the elapsed time 2, the remaining time 1.
  std::vector<std::pair<std::string, int>> more = {};
};

/// "rendering 12/48  [###-----------]  25 %  elapsed 10 s  ETA 30 s", cut to `width` columns. ASCII. Without
/// a width, as in a log, the line is whole and has no bar.
std::string progress_text(const Progress& progress, std::optional<int> width);

/// Things that are made one by one.
Progress count_progress(const std::string& label, std::size_t done, std::size_t count, double elapsed);

/// Where a run is.
struct RunShown {
  session::Phase phase = session::Phase::deposition;
  double time = 0.0;                     ///< s, of the model
  double tilt = 0.0;                     ///< deg
  std::optional<double> share;           ///< of this phase that is done
  std::optional<double> repose_assumed;  ///< deg, where the share assumes that the slope fails
  double residual = 0.0;
  double kinetic_energy = 0.0;  ///< J
  double velocity = 0.0;        ///< rms, over g h
  int contacts = 0;
};
Progress run_progress(const RunShown& shown, double elapsed, std::optional<double> remaining);

class StatusLine {
 public:
  /// A quiet line shows nothing. Between two lines pass at least `on_terminal` seconds, or `in_log`.
  StatusLine(bool quiet, double on_terminal, double in_log);
  /// Finishes the line, so that an error message begins on a line of its own.
  ~StatusLine() { finish(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Whether enough time has passed since the line was last shown, or made; at the end of the work a terminal
  /// shows it in any case.
  bool is_due(bool at_end = false) const;
  void show(const Progress& progress);
  /// Seconds since the line was made.
  double elapsed() const { return std::chrono::duration<double>(Clock::now() - begun_).count(); }
  /// Leaves the line as it is and goes to the next.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  bool quiet_, terminal_;
  bool open_ = false;  ///< a line of the terminal waits for its end
  std::chrono::duration<double> interval_;
  Clock::time_point begun_ = Clock::now(), shown_ = begun_;
};

/// Shows the progress of one who counts on a line of its own, from the first call on. Most calls do nothing,
/// since little time has passed since the last.
CountDone count_shown(std::string label, bool quiet);

/// Shows where a run is, in the same way; the line ends when the last copy of the function is gone.
std::function<void(const session::RunProgress&)> run_shown(bool quiet);

}  // namespace talus::app
