#include "app/runs_progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "app/progress_text.h"

namespace talus {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

RunsProgress::RunsProgress(ProgressWords words, std::vector<AwaitedRun> awaited, std::size_t complete,
                           int at_once)
    : words_(std::move(words)),
      awaited_(std::move(awaited)),
      complete_(complete),
      at_once_(at_once),
      terminal_(isatty(STDERR_FILENO) != 0) {
  for (const AwaitedRun& run : awaited_) waiting_estimate_ += run.estimate;
}

void RunsProgress::start(std::size_t run) {
  running_.emplace(run, Clock::now());
  waiting_estimate_ -= awaited_[run].estimate;
}

void RunsProgress::end(std::size_t run, int exit_code) {
  const double seconds = seconds_since(running_.at(run));
  running_.erase(run);
  if (exit_code == 0) {
    ++ended_;
    ended_estimate_ += awaited_[run].estimate;
    ended_seconds_ += seconds;
  }
  if (terminal_) return;
  const std::string how = exit_code == 0 ? "done" : "ended with exit code " + std::to_string(exit_code);
  std::fprintf(stderr, "%s %s after %s; %s\n", awaited_[run].name.c_str(), how.c_str(),
               duration_text(seconds).c_str(), fitted_line(fields(), std::nullopt).c_str());
}

/// Runs that ended tell how far the estimates are off; those under way count with what is left of them.
double RunsProgress::seconds_left() const {
  const double pace = ended_estimate_ > 0.0 ? ended_seconds_ / ended_estimate_ : 1.0;
  double left = pace * waiting_estimate_;
  double longest = 0.0;
  for (const auto& [run, since] : running_) {
    const double rest = std::max(0.0, pace * awaited_[run].estimate - seconds_since(since));
    left += rest;
    longest = std::max(longest, rest);
  }
  return std::max(left / at_once_, longest);
}

std::vector<ProgressField> RunsProgress::fields() const {
  return {{std::to_string(complete_ + ended_) + " of " + std::to_string(complete_ + awaited_.size()) + " " +
               words_.counted + " done, " + std::to_string(running_.size()) + " under way",
           0},
          {std::string("ETA ").append(duration_text(seconds_left())), 1},
          {std::string("(").append(duration_text(seconds_since(begin_))).append(")"), 2}};
}

void RunsProgress::show() const {
  if (!terminal_) return;
  std::vector<ProgressField> line = fields();
  line.insert(line.begin(), {words_.label, 0});
  std::fprintf(stderr, "\r\033[K%s", fitted_line(line, terminal_columns()).c_str());
}

void RunsProgress::finish() const {
  if (terminal_) std::fputc('\n', stderr);
}

}  // namespace talus
