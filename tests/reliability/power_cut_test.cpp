/// Loss of power during a computation: an ext4 file system on a loop device, shut down without writing the
/// data still in memory.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

#include "io/run_file.h"
#include "reliability/whole_run.h"
#include "support/runs.h"

namespace talus::test {
namespace {

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
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  const std::string whole = digest(kept_run(small_bed).string());
  const Disk disk(folder);
  if (!disk.is_ready()) GTEST_SKIP() << "needs root, loop devices and mkfs.ext4";
  const std::string run = disk.place() + "/run.h5";
  const std::vector<std::string> resume = {"run", "bed.toml", "-o", "disk/run.h5", "--resume"};
  Dice dice(11);
  const int cuts = tries(1, 100);
  int durable_seen = 0, whole_runs = 0;
  for (int k = 0; k < cuts; ++k) {
    SCOPED_TRACE("cut " + std::to_string(k));
    const pid_t process = start_talus(resume, folder.path());
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
    EXPECT_EQ(run_talus(resume, folder.path()).exit_code, 0);
    EXPECT_EQ(digest(run), whole);
    fs::remove(run);
    ++whole_runs;
  }
  EXPECT_EQ(run_talus(resume, folder.path()).exit_code, 0);
  EXPECT_EQ(digest(run), whole);
  EXPECT_GT(durable_seen, 0);
  std::printf("%d power cuts: none of %d durable frames lost, %d runs ended as they should\n", cuts,
              durable_seen, whole_runs + 1);
}

}  // namespace
}  // namespace talus::test
