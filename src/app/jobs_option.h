#pragma once
/// Option --jobs of commands that compute many beds.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <thread>

#include "app/choices.h"

namespace talus::app {

/// Returns the number of processors of this machine, the default number of beds computed in parallel.
inline int default_jobs() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

inline void add_jobs_option(CLI::App& command, int& jobs) {
  command
      .add_option("--jobs", jobs,
                  "Number of parallel workers, each on one thread; 0 leaves missing members to others (talus "
                  "ensemble work or submit)")
      ->capture_default_str()
      ->check(in_range(0, 256));
}

}  // namespace talus::app
