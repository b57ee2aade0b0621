#pragma once
/// Progress of things that are made one by one: a line that is rewritten on a terminal, plain lines every few
/// seconds in a log.

#include <chrono>
#include <cstddef>
#include <string>

namespace talus {

class CountProgress {
 public:
  /// `label` says what is done: "rendering".
  CountProgress(std::string label, std::size_t count, bool quiet);
  ~CountProgress();
  CountProgress(const CountProgress&) = delete;
  CountProgress& operator=(const CountProgress&) = delete;

  /// `done` of them are there. Most calls do nothing, as time since the last line is short.
  void show(std::size_t done);

 private:
  using Clock = std::chrono::steady_clock;
  std::string label_;
  std::size_t count_;
  bool quiet_;
  bool terminal_;
  bool open_ = false;  ///< a line of the terminal waits for its end
  Clock::time_point begin_ = Clock::now();
  Clock::time_point shown_ = begin_;
};

}  // namespace talus
