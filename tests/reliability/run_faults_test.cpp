/// Faults at any call of a complete run: committed data are kept, the message describes the fault, and
/// --resume alone brings the run to the same end.

#include <gtest/gtest.h>
#include <sys/resource.h>

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

const std::vector<std::string> command = {"run", "bed.toml", "-o", "run.h5", "--threads", "1", "--quiet"};

std::vector<std::string> resumed() {
  std::vector<std::string> words = command;
  words.emplace_back("--resume");
  return words;
}

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
    const TemporaryFolder folder;
    write_file(folder, "bed.toml", tiny_bed);
    std::vector<std::string> environment = with_fault(fault);
    environment.push_back("TALUS_FAULT_COUNT=" + folder.path(".counts"));
    const Outcome outcome = run_talus(command, folder.path(), environment);
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

  void finish_run(const TemporaryFolder& folder) {
    const Outcome outcome = run_talus(resumed(), folder.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
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
      EXPECT_NE(outcome.err.find(std::strerror(errno_value)), std::string::npos) << outcome.err;
      EXPECT_TRUE(outcome.err.find("run.h5") != std::string::npos ||
                  outcome.err.find("bed.toml") != std::string::npos)
          << outcome.err;
    }
    EXPECT_GT(refused, 5) << "no fault occurred, so nothing was tested";
    std::printf("%s %s: %d points ended with an error", kind.c_str(), std::strerror(errno_value), refused);
    for (const auto& [name, times] : harmless) std::printf(", %d of %s did no harm", times, name.c_str());
    std::printf("\n");
  }

  TemporaryFolder reference_folder_;
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
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(command, folder.path(), with_fault("clock")).exit_code, 0);
  EXPECT_EQ(digest(folder.path("run.h5")), reference_);
}

TEST_F(RunFaults, a_file_that_may_not_grow_is_an_error_and_not_a_signal) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small = {16384, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const Outcome outcome = run_talus(command, folder.path());
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(outcome.exit_code, 74);
  EXPECT_NE(outcome.err.find(std::strerror(EFBIG)), std::string::npos) << outcome.err;
  finish_run(folder);
}

TEST_F(RunFaults, results_that_cannot_be_printed_are_an_error) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "needs /dev/full";
  const std::string shell = talus_program() + " info " + reference_folder_.path("run.h5") +
                            " > /dev/full 2> " + reference_folder_.path("said");
  const int status = std::system(shell.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 74);
}

TEST_F(RunFaults, without_ffmpeg_no_movie_is_left) {
  const std::set<std::string> before = files_in(reference_folder_.path());
  const Outcome outcome = run_talus({"animate", "run.h5", "--map", "pressure", "-o", "run.mp4"},
                                    reference_folder_.path(), {"PATH=/nowhere"});
  EXPECT_EQ(outcome.exit_code, 69);
  EXPECT_NE(outcome.err.find("ffmpeg is not installed"), std::string::npos) << outcome.err;
  EXPECT_EQ(files_in(reference_folder_.path()), before);
}

TEST_F(RunFaults, on_a_full_disk_it_waits_for_room) {
  const TemporaryFolder folder;
  const SmallDisk disk(folder.path() / "disk");
  if (!disk.is_mounted()) GTEST_SKIP() << "needs root, to mount a small file system";
  write_file(folder, "bed.toml", tiny_bed);
  const auto on_disk = [](std::vector<std::string> words) {
    words[3] = "disk/run.h5";
    return words;
  };
  const std::string run = folder.path("disk/run.h5");
  const int sizes = 20;
  int full = 0;
  for (int k = 0; k < sizes; k += stride(sizes, 3)) {
    const int kib = 40 + 24 * k;
    SCOPED_TRACE(std::to_string(kib) + " KiB");
    ASSERT_TRUE(disk.resize(kib));
    const Outcome outcome = run_talus(on_disk(command), folder.path());
    EXPECT_EQ(outcome.exit_code, 74) << outcome.err;
    if (outcome.exit_code == 74) ++full;
    EXPECT_NE(outcome.err.find(std::strerror(ENOSPC)), std::string::npos) << outcome.err;
    const int frames = committed_frames(run);
    ASSERT_TRUE(disk.resize(16384));
    const Outcome after = run_talus(on_disk(resumed()), folder.path());
    EXPECT_EQ(after.exit_code, 0) << after.err;
    EXPECT_EQ(digest(run), reference_) << "after " << frames << " frames";
    fs::remove(run);
  }
  std::printf("full at %d sizes\n", full);
}

TEST_F(RunFaults, a_folder_that_may_not_be_written_is_said) {
  const TemporaryFolder folder;
  const SmallDisk disk(folder.path() / "disk");
  if (!disk.is_mounted()) GTEST_SKIP() << "needs root, to mount a small file system";
  ASSERT_TRUE(disk.forbid_writing());
  write_file(folder, "bed.toml", tiny_bed);
  const Outcome outcome = run_talus({"run", "bed.toml", "-o", "disk/run.h5"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 73);
  EXPECT_EQ(outcome.err, "talus: error: disk/run.h5.run: cannot create the folder: Read-only file system\n");
}

}  // namespace
}  // namespace talus::test
