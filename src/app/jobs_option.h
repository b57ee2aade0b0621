#pragma once
/// The option --jobs of commands that compute many beds.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <thread>

#include "app/choices.h"

namespace talus::app {

/// Processors of this machine: how many beds are computed side by side where nothing is asked.
inline int default_jobs() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

inline void add_jobs_option(CLI::App& command, int& jobs) {
  command
      .add_option("--jobs", jobs,
                  "Workers side by side, each on one thread; with 0 what is missing is left to others "
                  "(talus ensemble work, or submit)")
      ->capture_default_str()
      ->check(in_range(0, 256));
}

}  // namespace talus::app
