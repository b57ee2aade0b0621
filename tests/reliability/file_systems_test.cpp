/// File systems without features of a local disk: locks, or the removal of open files. Loss of power during a
/// computation: an ext4 file system on a loop device, shut down without writing the data still in memory.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

#include "io/run_file.h"
#include "reliability/faults.h"
#include "reliability/outputs.h"
#include "reliability/whole_run.h"
#include "support/commands.h"
#include "support/places.h"
#include "support/runs.h"

namespace talus::test {
namespace {

Words without_locks(int error) {
  Words environment = with_fault("no-locks " + std::to_string(error)) +
                      Words{"HDF5_USE_FILE_LOCKING=TRUE"};  // a possible setting of a site
  return environment;
}

class WithoutLocks : public testing::TestWithParam<int> {
 protected:
  Outcome talus(const Words& arguments) { return folder_.talus(arguments, without_locks(GetParam())); }
  CommandFolder folder_;
};

TEST_P(WithoutLocks, a_run_is_read_computed_and_resumed) {
  write_file(folder_, "bed.toml", tiny_bed);
  const std::string whole = take_run(folder_, "whole.h5", tiny_bed);
  const Outcome info = talus({"info", "whole.h5"});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  EXPECT_EQ(info.err, "");
  const Words run = {"run", "bed.toml", "-q", "-o"};
  const auto to = [&run](const std::string& output) { return run + Words{output}; };
  const Outcome computed = talus(to("run.h5"));
  EXPECT_EQ(computed.exit_code, 0) << computed.err;
  EXPECT_EQ(count_of(computed.err, "talus: note: the file system has no locks"), 1u) << computed.err;
  EXPECT_EQ(digest(folder_.path("run.h5")), digest(whole));
  ASSERT_EQ(folder_.talus(to("part.h5"), with_fault("kill 120")).exit_code, faults::killed);
  EXPECT_EQ(talus({"info", "part.h5"}).exit_code, 0);
  EXPECT_TRUE(ends(talus({"run", "--resume", "part.h5", "-q"}), 0));
  EXPECT_EQ(digest(folder_.path("part.h5")), digest(whole));
  EXPECT_FALSE(folder_.has_file("part.h5.run") || folder_.has_file("run.h5.run"));
}

INSTANTIATE_TEST_SUITE_P(Errors, WithoutLocks,
                         testing::Values(ENOLCK, ENOSYS, EOPNOTSUPP, EROFS, EINVAL, EACCES, EPERM, EBADF));

class WithoutLockd : public CommandTest {
 protected:
  Outcome talus(const Words& arguments) { return folder_.talus(arguments, without_locks(ENOLCK)); }
};

TEST_F(WithoutLockd, every_kind_of_output_is_written) {
  take_run(folder_, "run.h5", tiny_bed);
  const std::vector<Words> commands = {
      {"analyze", "run.h5"},
      {"render", "run.h5", "--map", "gamma", "--set", "gamma_c=0.342", "--at", "0", "-o", "maps"},
      {"export", "run.h5", "--to", "csv", "-o", "tables"},
      {"check", "run.h5"},
  };
  for (const Words& words : commands) {
    const Outcome outcome = talus(words);
    EXPECT_EQ(outcome.exit_code, 0) << words[0] << ": " << outcome.err;
    EXPECT_FALSE(has(outcome.err, "malformed"));
  }
  fs::resize_file(folder_.path("run.h5"), fs::file_size(folder_.path("run.h5")) - 100);
  EXPECT_TRUE(ends(talus({"repair", "run.h5", "-o", "new.h5"}), 0));
}

TEST_F(WithoutLockd, workers_of_an_ensemble_go_by_heartbeats) {
  write_file(folder_, "bed.toml", tiny_bed);
  const Outcome ensemble = talus({"ensemble", "bed.toml", "--seeds", "1-4", "--jobs", "2", "-o", "e"});
  EXPECT_EQ(ensemble.exit_code, 0) << ensemble.err;
  EXPECT_EQ(count_of(ensemble.err, "talus: note: the file system has no locks"), 1u) << ensemble.err;
  std::string begun;
  for (const auto& log : fs::directory_iterator(folder_.path("e/workers")))
    begun += text_of(log.path().string());
  EXPECT_EQ(count_of(begun, " begun\n"), 4u) << begun;
  for (const std::string& name : names_in(folder_.path("e")))
    EXPECT_FALSE(name.ends_with(".lock") || has(name, ".claim-") || name.ends_with(".failed")) << name;
}

TEST_F(WithoutLockd, a_run_is_read_by_python) {
  if (std::system("/usr/bin/python3 -c 'import h5py' 2>/dev/null") != 0)
    GTEST_SKIP() << "python3-h5py is not installed";
  take_run(folder_, "run.h5", tiny_bed);
  for (const char* wish : {"", "HDF5_USE_FILE_LOCKING=TRUE", "HDF5_USE_FILE_LOCKING=BEST_EFFORT"}) {
    const std::string command =
        "cd " + folder_.path().string() + " && " + wish + " LD_PRELOAD=" + faults_library() +
        " TALUS_FAULT='no-locks 37' PYTHONPATH=" + source_folder() +
        "/python /usr/bin/python3 -c \"import talus; print(len(talus.open('run.h5').frames))\"" +
        " > read.txt 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << wish << folder_.text("read.txt");
    EXPECT_EQ(folder_.text("read.txt"), "8\n");
  }
}

TEST(OnNfs, where_a_file_that_is_open_is_not_removed_nothing_is_left_of_a_run) {
  const CommandFolder folder(tiny_bed);
  const Words environment = with_fault("keeps-open");
  const auto run = [&](const Words& more) {
    Words words = Words{"run", "bed.toml", "-o", "run.h5", "-q"} + more;
    return folder.talus(words, environment).exit_code;
  };
  EXPECT_EQ(run({}), 0);
  EXPECT_FALSE(folder.has_file("run.h5.run"));
  EXPECT_EQ(run({"--overwrite"}), 0);
  EXPECT_EQ(run({"--resume"}), 0) << "of a run that is complete";
  EXPECT_FALSE(folder.has_file("run.h5.run"));
}

namespace fs = std::filesystem;

constexpr unsigned long shut_down = 0x8004587d;  // EXT4_IOC_SHUTDOWN of the kernel
constexpr unsigned without_log = 2;              // data not on the disk are lost

bool succeeds(const std::string& command) {
  return std::system((command + " > /dev/null 2>&1").c_str()) == 0;
}

/// Fresh file system whose power can be cut.
class Disk {
 public:
  explicit Disk(const TemporaryFolder& folder)
      : image_(folder.path("disk.img")), place_(folder.path("disk")) {
    fs::create_directory(place_);
    ready_ = geteuid() == 0 && succeeds("truncate -s 64M " + image_) && succeeds("mkfs.ext4 -q " + image_) &&
             attach();
  }
  ~Disk() { detach(); }
  Disk(const Disk&) = delete;
  Disk& operator=(const Disk&) = delete;

  bool is_ready() const { return ready_; }
  const std::string& place() const { return place_; }
  bool attach() const { return succeeds("mount -o loop " + image_ + " " + place_); }
  void detach() const { succeeds("umount " + place_); }
  bool cut_power() const {
    const int root = open(place_.c_str(), O_RDONLY | O_CLOEXEC);
    const int result = ioctl(root, shut_down, &without_log);
    close(root);
    return result == 0;
  }

 private:
  std::string image_, place_;
  bool ready_ = false;
};

/// Returns the number of frames in commits that the run knows to be durable: only then does it remove the
/// checkpoint before the last two. -1 if this cannot be determined at the moment.
int durable_frames(const std::string& folder) {
  std::ifstream manifest(folder + "/manifest");
  int frames = 0;
  std::string checkpoint;
  for (std::string line; std::getline(manifest, line);) {
    std::istringstream words(line);
    std::string kind, name, size, hash;
    words >> kind >> name >> size >> hash;
    int count = 0;
    if (kind == "checkpoint") checkpoint = name;
    if (kind == "segment" && words >> count) frames += count;
  }
  std::error_code gone;
  std::set<std::string> checkpoints;
  for (const auto& entry : fs::directory_iterator(folder, gone))
    if (const std::string name = entry.path().filename().string(); name.starts_with("checkpoint_"))
      checkpoints.insert(name);
  const bool others_were_removed =
      checkpoints.size() == 2 && !checkpoints.begin()->starts_with("checkpoint_000001");
  return others_were_removed && *checkpoints.rbegin() == checkpoint ? frames : -1;
}

TEST(PowerCut, loses_no_committed_frame) {
  if (std::getenv("TALUS_RELIABILITY") == nullptr) GTEST_SKIP() << "only with TALUS_RELIABILITY set";
  const CommandFolder folder(short_bed);
  const std::string whole = digest(kept_run(short_bed).string());
  const Disk disk(folder);
  if (!disk.is_ready()) GTEST_SKIP() << "needs root, loop devices and mkfs.ext4";
  const std::string run = disk.place() + "/run.h5";
  const Words resume = {"run", "bed.toml", "-o", "disk/run.h5", "--resume"};
  Dice dice(11);
  const int cuts = tries(1, 100);
  int durable_seen = 0, whole_runs = 0;
  for (int k = 0; k < cuts; ++k) {
    SCOPED_TRACE("cut " + std::to_string(k));
    const pid_t process = folder.start(resume);
    int durable = 0;
    for (int wait = dice.below(600); wait > 0; --wait) {
      durable = std::max(durable, durable_frames(run + ".run"));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ASSERT_TRUE(disk.cut_power());
    kill(process, SIGKILL);
    wait_for(process);
    disk.detach();
    ASSERT_TRUE(disk.attach());
    EXPECT_GE(committed_frames(run), durable);
    durable_seen += durable;
    if (io::run_presence(run) != io::RunPresence::packed) continue;
    EXPECT_EQ(folder.talus(resume).exit_code, 0);
    EXPECT_EQ(digest(run), whole);
    fs::remove(run);
    ++whole_runs;
  }
  EXPECT_EQ(folder.talus(resume).exit_code, 0);
  EXPECT_EQ(digest(run), whole);
  EXPECT_GT(durable_seen, 0);
  std::printf("%d power cuts: none of %d durable frames lost, %d runs ended as they should\n", cuts,
              durable_seen, whole_runs + 1);
}

}  // namespace
}  // namespace talus::test
