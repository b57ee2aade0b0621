/// Faults at any call of a complete run: committed data are kept, the message describes the fault, and
/// --resume alone brings the run to the same end. For any failing allocation, a run reports it, crashes in
/// HDF5, or does not need it, and can be resumed.

#include <gtest/gtest.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>

#include "reliability/faults.h"
#include "reliability/small_disk.h"
#include "reliability/whole_run.h"
#include "support/places.h"

namespace talus::test {
namespace {

namespace fs = std::filesystem;

const Words command = {"run", "bed.toml", "-o", "run.h5", "--threads", "1", "--quiet"};

Words resumed() { return command + Words{"--resume"}; }

/// Returns the names in a folder, without those written by the test itself.
std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (const std::string name = entry.path().filename().string(); name[0] != '.') names.insert(name);
  return names;
}

/// A bed, and its undisturbed run.
class RunFaults : public testing::Test {
 protected:
  RunFaults() {
    write_file(reference_folder_, "bed.toml", tiny_bed);
    counts_ = count_calls(command, reference_folder_);
    reference_ = digest(reference_folder_.path("run.h5"));
    frames_ = committed_frames(reference_folder_.path("run.h5"));
  }

  /// Runs the bed under a fault in a separate folder. The committed data must be consistent, never less than
  /// after an earlier fault, and must lead to the same end.
  Outcome strike(const std::string& fault) {
    const CommandFolder folder(tiny_bed);
    Words environment = with_fault(fault) + Words{"TALUS_FAULT_COUNT=" + folder.path(".counts")};
    const Outcome outcome = folder.talus(command, environment);
    struck_ = read_counts(folder.path(".counts")).struck;
    const std::string run = folder.path("run.h5");
    const int found = committed_frames(run);
    EXPECT_GE(found, committed_before_) << "lost";
    if (outcome.exit_code == 0)
      EXPECT_EQ(digest(run), reference_) << "reported as complete";
    else
      committed_before_ = found;
    finish_run(folder);
    return outcome;
  }

  void finish_run(const CommandFolder& folder) {
    EXPECT_TRUE(ends(folder.talus(resumed()), 0));
    EXPECT_EQ(digest(folder.path("run.h5")), reference_);
    EXPECT_EQ(files_in(folder.path()), (std::set<std::string>{"bed.toml", "run.h5"}));
  }

  /// Injects an error at every call. It must end with an exit code of its kind and a message that names a
  /// file and the reason. It may be harmless only if an obsolete file was to be removed. A full disk remains
  /// readable.
  void strike_every_call(const std::string& kind, int errno_value) {
    int refused = 0;
    std::map<std::string, int> harmless;  // key: the call that failed
    for (int call = 1; call <= counts_.calls; call += stride(counts_.calls, 12)) {
      const std::string fault = kind + " " + std::to_string(errno_value) + " " + std::to_string(call);
      SCOPED_TRACE(fault);
      const Outcome outcome = strike(fault);
      if (outcome.exit_code == 0) {
        const std::string name = struck_.substr(0, struck_.find(' '));
        EXPECT_TRUE(name == "unlink" || name == "rmdir" || (name.empty() && errno_value == ENOSPC))
            << struck_;
        ++harmless[name.empty() ? "read" : name];
        continue;
      }
      ++refused;
      EXPECT_TRUE(outcome.exit_code == 74 || outcome.exit_code == 66) << outcome.exit_code;
      EXPECT_EQ(outcome.err.find("talus: error: "), 0u) << outcome.err;
      EXPECT_TRUE(has(outcome.err, std::strerror(errno_value)));
      EXPECT_TRUE(has(outcome.err, "run.h5") || has(outcome.err, "bed.toml")) << outcome.err;
    }
    EXPECT_GT(refused, 5) << "no fault occurred, so nothing was tested";
    std::printf("%s %s: %d points ended with an error", kind.c_str(), std::strerror(errno_value), refused);
    for (const auto& [name, times] : harmless) std::printf(", %d of %s did no harm", times, name.c_str());
    std::printf("\n");
  }

  CommandFolder reference_folder_;
  Counts counts_;
  std::string struck_;  ///< call that failed last
  std::string reference_;
  int frames_ = 0;
  int committed_before_ = 0;
};

TEST_F(RunFaults, killed_at_any_call_it_is_resumed_to_the_same_end) {
  ASSERT_GT(counts_.calls, 100);
  ASSERT_EQ(frames_, 8);
  int kills = 0;
  for (int call = 1; call <= counts_.calls; call += stride(counts_.calls, 12)) {
    SCOPED_TRACE("call " + std::to_string(call));
    EXPECT_EQ(strike("kill " + std::to_string(call)).exit_code, faults::killed);
    ++kills;
  }
  std::printf("killed at %d of %d calls\n", kills, counts_.calls);
}

TEST_F(RunFaults, an_error_of_the_device_at_any_call_is_said) { strike_every_call("error", EIO); }
TEST_F(RunFaults, a_lasting_error_of_the_device_is_said) { strike_every_call("lasting", EIO); }
TEST_F(RunFaults, no_space_at_any_call_is_said) { strike_every_call("error", ENOSPC); }
TEST_F(RunFaults, a_disk_that_stays_full_is_said) { strike_every_call("lasting", ENOSPC); }

TEST_F(RunFaults, clocks_that_jump_change_nothing) {
  const CommandFolder folder(tiny_bed);
  ASSERT_EQ(folder.talus(command, with_fault("clock")).exit_code, 0);
  EXPECT_EQ(digest(folder.path("run.h5")), reference_);
}

TEST_F(RunFaults, results_that_cannot_be_printed_are_an_error) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  const std::string shell = talus_program() + " info " + reference_folder_.path("run.h5") +
                            " > /dev/full 2> " + reference_folder_.path("said");
  const int status = std::system(shell.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 74);
}

TEST_F(RunFaults, a_folder_that_may_not_be_written_is_said) {
  const CommandFolder folder;
  const SmallDisk disk(folder.path() / "disk");
  if (!disk.is_mounted()) GTEST_SKIP() << "needs root, to mount a small file system";
  ASSERT_TRUE(disk.forbid_writing());
  write_file(folder, "bed.toml", tiny_bed);
  const Outcome outcome = folder.talus({"run", "bed.toml", "-o", "disk/run.h5"});
  EXPECT_EQ(outcome.exit_code, 73);
  EXPECT_EQ(outcome.err, "talus: error: disk/run.h5.run: cannot create the folder: Read-only file system\n");
}

/// A bed reduced to its last steps: a start, some steps, commits, and the end.
const char* const short_bed =
    "seed = 5\n[bed]\nlength = 10\ndepth = 2\n[deposition]\nrest_velocity = 0.1\n"
    "[tilt]\nrate = 20\nstep = 0.02\nend_angle = 0.1\n[output]\nframe_every = 0.06\nobservable_every = "
    "0.02\n";

/// Fails one allocation after the other, each in a separate run.
void fail_every_allocation(const std::string& kind) {
  const CommandFolder folder(short_bed);
  const int allocations = count_calls(command, folder).allocations;
  ASSERT_GT(allocations, 1000);
  const std::string reference = digest(folder.path("run.h5"));
  int tried = 0, reported = 0, crashed = 0;
  for (int number = 1; number <= allocations; number += stride(allocations, 12)) {
    SCOPED_TRACE(kind + " " + std::to_string(number));
    std::filesystem::remove(folder.path("run.h5"));
    const Outcome outcome = folder.talus(command, with_fault(kind + " " + std::to_string(number)));
    // HDF5 may crash after a failed allocation of its own.
    EXPECT_TRUE(outcome.exit_code == 71 || outcome.exit_code == 0 || outcome.exit_code == -1)
        << outcome.exit_code << " " << outcome.err;
    ++tried;
    reported += outcome.exit_code == 71;
    crashed += outcome.exit_code == -1;
    Words resumed = command + Words{"--resume"};
    EXPECT_TRUE(ends(folder.talus(resumed), 0));
    EXPECT_EQ(digest(folder.path("run.h5")), reference);
  }
  EXPECT_GT(reported, 3) << "no fault occurred, so nothing was tested";
  std::printf("%s: %d allocations, %d tried: %d reported, %d crashed, %d harmless\n", kind.c_str(),
              allocations, tried, reported, crashed, tried - reported - crashed);
}

TEST(RunMemory, one_allocation_that_fails_is_told) { fail_every_allocation("memory"); }
TEST(RunMemory, all_allocations_from_one_on_are_told) { fail_every_allocation("no-memory"); }

}  // namespace
}  // namespace talus::test
