#pragma once
/// Progress of things that are made one by one, on the line of a terminal, or now and then in a log.

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>

#include "app/status_line.h"

namespace talus {

class CountProgress {
 public:
  /// `label` says what is done: "rendering".
  CountProgress(std::string label, std::size_t count, bool quiet);

  /// `done` of them are there. Most calls do nothing, since little time has passed since the last.
  void show(std::size_t done);

 private:
  using Clock = std::chrono::steady_clock;
  std::string label_;
  std::size_t count_;
  StatusLine line_;
  Clock::time_point begin_ = Clock::now();
};

/// Shows the progress of one who counts: to be called with how many are done, and how many there are in all.
/// Where the count begins again, so does the line. Empty where it is to be quiet.
std::function<void(std::size_t done, std::size_t count)> count_shown(std::string label, bool quiet);

}  // namespace talus
