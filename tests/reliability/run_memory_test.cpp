/// For any failing allocation, a run reports it or does not need it, and can be resumed.

#include <gtest/gtest.h>

#include "reliability/whole_run.h"

namespace talus::test {
namespace {

/// A bed reduced to its last steps: a start, some steps, commits, and the end.
const char* const short_bed =
    "seed = 5\n[bed]\nlength = 10\ndepth = 2\n[deposition]\nrest_velocity = 0.1\n"
    "[tilt]\nrate = 20\nstep = 0.02\nend_angle = 0.1\n[output]\nframe_every = 0.06\nobservable_every = "
    "0.02\n";

const std::vector<std::string> command = {"run", "bed.toml", "-o", "run.h5", "--threads", "1", "--quiet"};

/// Fails one allocation after the other, each in a separate run.
void fail_every_allocation(const std::string& kind) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", short_bed);
  const int allocations = count_calls(command, folder).allocations;
  ASSERT_GT(allocations, 1000);
  const std::string reference = digest(folder.path("run.h5"));
  int tried = 0, reported = 0;
  for (int number = 1; number <= allocations; number += stride(allocations, 12)) {
    SCOPED_TRACE(kind + " " + std::to_string(number));
    std::filesystem::remove(folder.path("run.h5"));
    const Outcome outcome =
        run_talus(command, folder.path(), with_fault(kind + " " + std::to_string(number)));
    EXPECT_TRUE(outcome.exit_code == 71 || outcome.exit_code == 0) << outcome.exit_code << " " << outcome.err;
    ++tried;
    reported += outcome.exit_code == 71;
    std::vector<std::string> resumed = command;
    resumed.emplace_back("--resume");
    const Outcome after = run_talus(resumed, folder.path());
    EXPECT_EQ(after.exit_code, 0) << after.err;
    EXPECT_EQ(digest(folder.path("run.h5")), reference);
  }
  EXPECT_GT(reported, 3) << "no fault occurred, so nothing was tested";
  std::printf("%s: %d allocations, %d tried: %d reported, %d harmless\n", kind.c_str(), allocations, tried,
              reported, tried - reported);
}

TEST(RunMemory, one_allocation_that_fails_is_told) { fail_every_allocation("memory"); }
TEST(RunMemory, all_allocations_from_one_on_are_told) { fail_every_allocation("no-memory"); }

}  // namespace
}  // namespace talus::test
