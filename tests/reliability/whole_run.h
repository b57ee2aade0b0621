#pragma once
/// Whole runs of the program that are disturbed, and what is asked of them afterwards.

#include <string>

#include "core/snapshot.h"
#include "support/process.h"

namespace talus::test {

/// How often something is tried: `few` times in ctest. With the variable TALUS_RELIABILITY set to a number,
/// that number times `many`: 1 for the figures of docs/reliability.md.
int tries(int few, int many);

/// Every how manieth of `count` cases is tried: `few` of them in ctest, all with TALUS_RELIABILITY=1.
int stride(int count, int few);

/// A bed of 30 grains that is computed in a tenth of a second, with 8 frames.
extern const char* const tiny_bed;
/// One of 96 grains that takes about a second, with 13 frames.
extern const char* const small_bed;

/// Everything that a run holds but its provenance and its times: frames with contacts, observables, steps,
/// commands, results, final state. Equal for equal bits. `complete` of its last character: folder or file.
std::string digest(const std::string& run);

/// The same of a frame alone.
std::string frame_digest(const Frame& frame);

/// The frames that are committed in the folder of a run or in its file; 0 where there is no run. Reads and
/// verifies all of it.
int committed_frames(const std::string& run);

/// The environment in which a fault strikes (preload.cpp).
std::vector<std::string> with_fault(const std::string& fault);

/// Calls to the system, and allocations, of a command.
struct Counts {
  int calls = 0;
  int allocations = 0;
  std::string struck;  ///< the call that a fault made fail, and its path; empty without one
};
/// Of one without a fault.
Counts count_calls(const std::vector<std::string>& arguments, const TemporaryFolder& folder);
/// From the file that TALUS_FAULT_COUNT named.
Counts read_counts(const std::string& path);

/// A number in 0 ... bound - 1 from a sequence that is the same each time.
class Dice {
 public:
  explicit Dice(unsigned seed) : state_(seed) {}
  int below(int bound) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<int>((state_ >> 33) % static_cast<unsigned>(bound));
  }

 private:
  unsigned long long state_;
};

}  // namespace talus::test
