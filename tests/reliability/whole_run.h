#pragma once
/// Complete runs of the program that are disturbed, and checks of the results.

#include <string>

#include "core/snapshot.h"
#include "support/commands.h"

namespace talus::test {

/// Returns the number of tries: `few` in ctest; if the variable TALUS_RELIABILITY is a number, that number
/// times `many`: 1 gives the figures of docs/reliability.md.
int tries(int few, int many);

/// Returns the stride through `count` cases: about `few` of them are tried in ctest, and all with
/// TALUS_RELIABILITY=1.
int stride(int count, int few);

/// Bed of 30 grains with 8 frames, computed in a tenth of a second.
extern const char* const tiny_bed;
/// Bed of 96 grains with 13 frames, which takes about a second.
extern const char* const short_bed;

/// Returns a digest of everything in a run except its provenance and its times: frames with contacts,
/// observables, steps, commands, results, final state. Equal for equal bits. `complete` in its last
/// character: folder or file.
std::string digest(const std::string& run);

/// Returns the digest of a single frame.
std::string frame_digest(const Frame& frame);

/// Returns the number of frames committed in the folder of a run or in its file; 0 if there is no run. Reads
/// and verifies everything.
int committed_frames(const std::string& run);

/// Returns the environment that injects a fault (preload.cpp).
Words with_fault(const std::string& fault);

/// Numbers of system calls and of allocations of a command.
struct Counts {
  int calls = 0;
  int allocations = 0;
  std::string struck;  ///< call that a fault made fail, and its path; empty if there was none
};
/// Counts those of a command without a fault.
Counts count_calls(const Words& arguments, const TemporaryFolder& folder);
/// Reads the file named by TALUS_FAULT_COUNT.
Counts read_counts(const std::string& path);

/// Expects that nothing that a command prints controls the terminal.
inline void expect_no_controls(const Outcome& outcome) {
  for (const std::string& text : {outcome.out, outcome.err}) {
    EXPECT_EQ(text.find_first_of("\x1b\a\r\x7f\xff"), std::string::npos) << text;
    EXPECT_FALSE(has(text, "\xc2\x9b"));
  }
}

/// Reproducible sequence of numbers in 0 ... bound - 1.
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
