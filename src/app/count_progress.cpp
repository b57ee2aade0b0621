#include "app/count_progress.h"

#include <unistd.h>

#include <cstdio>

#include "app/progress_text.h"

namespace talus {

CountProgress::CountProgress(std::string label, std::size_t count, bool quiet)
    : label_(std::move(label)), count_(count), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

CountProgress::~CountProgress() {
  if (open_) std::fputc('\n', stderr);
}

void CountProgress::show(std::size_t done) {
  constexpr double seconds_on_terminal = 0.1, seconds_in_log = 5.0;
  const auto seconds = [](Clock::duration time) { return std::chrono::duration<double>(time).count(); };
  const Clock::time_point now = Clock::now();
  const bool last = terminal_ && done == count_;
  if (quiet_ || (!last && seconds(now - shown_) < (terminal_ ? seconds_on_terminal : seconds_in_log))) return;
  shown_ = now;
  std::string text = label_ + " " + std::to_string(done) + "/" + std::to_string(count_);
  if (done > 0 && done < count_)
    text += "  ETA " + duration_text(seconds(now - begin_) / static_cast<double>(done) *
                                     static_cast<double>(count_ - done));
  std::fprintf(stderr, terminal_ ? "\r\033[K%s" : "%s\n", text.c_str());
  open_ = terminal_;
}

}  // namespace talus
