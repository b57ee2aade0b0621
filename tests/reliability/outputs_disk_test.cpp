/// Outputs of commands are complete or absent, on a disk of any size and under any limit. ctest tries a few
/// sizes; with TALUS_RELIABILITY=1, every block up to a sufficient size.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <functional>

#include "reliability/outputs.h"
#include "reliability/small_disk.h"

namespace talus::test {
namespace {

/// Runs a writer in a place of some KiB with the names expected there; returns whether it succeeded.
using TryAt = std::function<bool(const Writer& writer, const std::set<std::string>& expected, int kib)>;

class OutputsOfAllSizes : public Outputs {
 protected:
  /// Tries all writers in places of growing sizes until they succeed. Returns the number of failures.
  int count_too_small(const TryAt& try_at) {
    int tried = 0, too_small = 0;
    for (const Writer& writer : writers()) {
      SCOPED_TRACE(writer.name);
      const auto [expected, size] = undisturbed_files(writer);
      for (const int kib : sizes_about(size)) {
        SCOPED_TRACE(std::to_string(kib) + " KiB");
        ++tried;
        if (try_at(writer, expected, kib)) break;
        ++too_small;
      }
    }
    std::printf("%d places, %d of them too small\n", tried, too_small);
    return too_small;
  }
};

TEST_F(OutputsOfAllSizes, are_whole_or_absent_on_small_disks) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root, to mount a small file system";
  const int full = count_too_small([this](const Writer& writer, const auto& expected, int kib) {
    const SmallDisk disk(folder_.path() / "disk", kib);
    EXPECT_TRUE(disk.is_mounted());
    return is_done_or_reported(writer, "disk", expected);
  });
  EXPECT_GT(full, 12);
}

/// Limits the size of files to this many bytes during its lifetime.
class SizeLimit {
 public:
  explicit SizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }
  SizeLimit(const SizeLimit&) = delete;
  SizeLimit& operator=(const SizeLimit&) = delete;

 private:
  rlimit before_{};
};

TEST_F(OutputsOfAllSizes, are_whole_or_absent_where_files_may_not_grow) {
  const int full = count_too_small([this](const Writer& writer, const auto& expected, int kib) {
    fs::create_directory(path("limited"));
    const bool is_done = [&] {
      const SizeLimit limit(static_cast<rlim_t>(1024) * static_cast<rlim_t>(kib));
      return is_done_or_reported(writer, "limited", expected);
    }();
    fs::remove_all(path("limited"));
    return is_done;
  });
  EXPECT_GT(full, 10);
}

}  // namespace
}  // namespace talus::test
