#pragma once
/// Progress of several runs, or analyses: one line that is rewritten on a terminal, a line for each that ends
/// in a log.

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "app/progress_text.h"

namespace talus {

/// A run, or an analysis, that has still to be computed.
struct AwaitedRun {
  std::string name;
  double estimate = 0.0;  ///< s on one core, before anything is known
};

/// How the line begins, and what it counts.
struct ProgressWords {
  std::string label;    ///< "study"
  std::string counted;  ///< "runs"
};

class RunsProgress {
 public:
  /// `complete` of them were there before.
  RunsProgress(ProgressWords words, std::vector<AwaitedRun> awaited, std::size_t complete, int at_once);

  void start(std::size_t run);
  void end(std::size_t run, int exit_code);
  /// Rewrites the line of a terminal.
  void show() const;
  /// Leaves the line as it is and goes to the next.
  void finish() const;

 private:
  using Clock = std::chrono::steady_clock;
  double seconds_left() const;
  std::vector<ProgressField> fields() const;

  ProgressWords words_;
  std::vector<AwaitedRun> awaited_;
  std::size_t complete_;
  std::size_t ended_ = 0;
  int at_once_;
  bool terminal_;
  Clock::time_point begin_ = Clock::now();
  std::map<std::size_t, Clock::time_point> running_;  ///< since when
  double waiting_estimate_ = 0.0;                     ///< s, of the runs not started
  double ended_estimate_ = 0.0;                       ///< s, of the runs that ended well
  double ended_seconds_ = 0.0;                        ///< s, what these really took
};

}  // namespace talus
