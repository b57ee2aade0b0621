#pragma once
/// A small run with a value of its own in every field, for the tests of the run store.

#include <filesystem>
#include <string>

#include "io/run_store.h"

namespace talus::example {

/// An empty folder that is removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

inline constexpr Index grain_count = 6;
inline constexpr Index free_grain_count = 4;

RunHeader header();
/// Commit number k holds k % 3 frames, at ascending tilts, and 2 rows of observables and 5 of steps.
Segment segment(int k);
Checkpoint checkpoint(int k);

/// A store with the commits 0 ... count - 1.
RunStore store_with_commits(const std::string& path, int count);

std::string file_text(const std::string& path);
void write_text(const std::string& path, const std::string& text);

}  // namespace talus::example
