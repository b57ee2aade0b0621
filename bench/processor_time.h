#pragma once
/// Time as the processor counts it.

#include <ctime>

namespace talus::bench {

/// Processor time of the calling thread, s: what a solve on one core costs, whatever else the machine does.
inline double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace talus::bench
