#pragma once
/// Processor time.

#include <ctime>

namespace talus::bench {

/// Returns the processor time of the calling thread, s, which hardly depends on other load.
inline double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace talus::bench
