/// Runs that are killed, stopped, asked to checkpoint, started twice, or whose folder is removed.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <future>
#include <set>
#include <sstream>
#include <string>
#include <thread>

#include "io/run_file.h"
#include "reliability/whole_run.h"

namespace talus::test {
namespace {

namespace fs = std::filesystem;

void pause(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

bool is_running(pid_t process) { return waitpid(process, nullptr, WNOHANG) == 0; }

/// A bed, its undisturbed run, and a place for disturbed runs.
class RunStops : public CommandTest {
 protected:
  RunStops() {
    write_file(folder_, "bed.toml", short_bed);
    const Clock::time_point start = Clock::now();
    EXPECT_EQ(folder_.talus({"run", "bed.toml", "-o", "whole.h5", "--threads", "1"}).exit_code, 0);
    milliseconds_ = static_cast<int>(1000.0 * seconds_since(start));
    whole_ = digest(folder_.path("whole.h5"));
  }

  pid_t start_or_resume() const {
    return folder_.start({"run", "bed.toml", "-o", "run.h5", "--threads", "1", "--resume"});
  }

  /// Completes the run by its name alone, if it exists, and removes it.
  void finish() {
    Words command = {"run", "--resume", "run.h5", "--threads", "1"};
    if (io::run_presence(run_) == io::RunPresence::none)
      command = {"run", "bed.toml", "-o", "run.h5", "--resume"};
    EXPECT_TRUE(ends(folder_.talus(command), 0));
    EXPECT_EQ(digest(run_), whole_);
    EXPECT_FALSE(fs::exists(run_ + ".run"));
    fs::remove(run_);
  }
  const std::string run_ = folder_.path("run.h5");
  std::string whole_;
  int milliseconds_ = 0;  ///< duration of the run
  Dice dice_{7};
};

TEST_F(RunStops, ended_one_to_five_times_it_has_the_same_bits) {
  const int runs = tries(2, 200), signals[] = {SIGINT, SIGTERM, SIGKILL};
  int ends = 0;
  for (int k = 0; k < runs; ++k) {
    SCOPED_TRACE("run " + std::to_string(k));
    const int most = 1 + dice_.below(5);
    for (int end = 0; end < most; ++end) {
      const pid_t process = start_or_resume();
      if (end == 0)  // leaves something to resume at least once on a slow machine
        EXPECT_TRUE(wait_until([this] { return io::run_presence(run_) != io::RunPresence::none; }));
      else
        pause(dice_.below(milliseconds_ / 2));
      kill(process, signals[dice_.below(3)]);
      const int code = wait_for(process);
      EXPECT_TRUE(code == -1 || code == 75 || code == 0)
          << code;  // -1: killed, or the signal was not handled yet
      ends += code != 0;
    }
    finish();
  }
  EXPECT_GE(ends, runs);
  std::printf("%d runs ended %d times before their end: all equal\n", runs, ends);
}

TEST_F(RunStops, killed_at_a_random_time_it_loses_no_frame) {
  const int kills = tries(10, 1000);
  int frames_seen = 0, whole_runs = 0;
  for (int k = 0; k < kills; ++k) {
    SCOPED_TRACE("kill " + std::to_string(k));
    const pid_t process = start_or_resume();
    pause(dice_.below(milliseconds_));  // pauses longer than a checkpoint advance the run
    const std::size_t committed = io::run_presence(run_) == io::RunPresence::none
                                      ? 0
                                      : io::RunFile::open(run_).all_frame_tilts().size();
    kill(process, SIGKILL);
    wait_for(process);
    const int found = committed_frames(run_);
    EXPECT_GE(found, static_cast<int>(committed));
    frames_seen += found;
    if (io::run_presence(run_) != io::RunPresence::packed) continue;
    finish();
    ++whole_runs;
  }
  EXPECT_GT(frames_seen, 0);
  std::printf("%d kills: every folder opened, no frame lost, %d runs ended as they should\n", kills,
              whole_runs);
}

TEST_F(RunStops, told_to_stop_it_leaves_a_checkpoint) {
  const int stops = tries(6, 500);
  int stopped = 0;
  double longest = 0.0;
  for (int k = 0; k < stops; ++k) {
    SCOPED_TRACE("stop " + std::to_string(k));
    const pid_t process = start_or_resume();
    // It handles signals before it takes its lock, which names its process.
    const std::string holder = "process " + std::to_string(process) + " ";
    EXPECT_TRUE(wait_until([&] {
      return text_of(run_ + ".run/lock").starts_with(holder) ||
             io::run_presence(run_) == io::RunPresence::packed;
    }));
    pause(k == 0 ? 0 : dice_.below(milliseconds_ / 4));
    const Clock::time_point start = Clock::now();
    kill(process, k % 2 == 0 ? SIGINT : SIGTERM);
    const int code = wait_for(process);
    longest = std::max(longest, seconds_since(start));
    EXPECT_TRUE(code == 75 || code == 0) << code;
    stopped += code == 75;
    committed_frames(run_);
    if (io::run_presence(run_) == io::RunPresence::packed) finish();
  }
  EXPECT_GT(stopped, 0);
  std::printf("%d stops: %d left with 75, the others had come to their end; the longest took %.3f s\n", stops,
              stopped, longest);
}

/// A bed with a step that does not end, followed by steps without frames for a minute.
const char* const endless_step =
    "[bed]\nlength = 100\ndepth = 30\n[solver]\nmethod = \"gauss-seidel\"\ntolerance = 1e-12\n"
    "moving_tolerance = 1e-12\nmax_iterations = 10000000\n[deposition]\nmethod = \"collapse\"\n"
    "initial_solid_fraction = 0.7\n";
const char* const long_deposition = "[bed]\nlength = 50\ndepth = 20\n[output]\ncheckpoint_every = 86400\n";

/// Returns the processor time that a process has used, s: on a busy machine it may not run for a while.
double processor_time(pid_t process) {
  const std::string text = text_of("/proc/" + std::to_string(process) + "/stat");
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  std::string skipped;
  for (int field = 3; field < 14; ++field) fields >> skipped;
  double user = 0.0, system = 0.0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

class LongRun : public CommandTest {
 protected:
  /// Starts the bed, and returns once the run exists.
  pid_t start(const char* bed) {
    write_file(folder_, "bed.toml", bed);
    const pid_t process = folder_.start({"run", "bed.toml", "-o", "run.h5"});
    EXPECT_TRUE(wait_until([this] { return fs::exists(manifest_); }));
    return process;
  }
  void end(pid_t process) {
    kill(process, SIGKILL);
    wait_for(process);
  }
  const std::string run_ = folder_.path("run.h5");
  const std::string manifest_ = run_ + ".run/manifest";
};

TEST_F(LongRun, leaves_at_once_when_told_twice) {
  const pid_t process = start(endless_step);
  // The first grains touch after some hundred steps, in a step that does not end.
  for (std::string before = "?"; before != text_of(manifest_);) {
    before = text_of(manifest_);
    kill(process, SIGUSR1);
    const double worked = processor_time(process);
    ASSERT_TRUE(wait_until([&] { return processor_time(process) > worked + 0.3; }));
  }
  kill(process, SIGTERM);
  pause(100);
  kill(process, SIGINT);
  pause(1100);
  ASSERT_TRUE(is_running(process)) << "a repetition within a second, or the step ended";
  const Clock::time_point start = Clock::now();
  kill(process, SIGINT);
  EXPECT_EQ(wait_for(process), 75);
  std::printf("the second signal took %.3f s\n", seconds_since(start));
  EXPECT_EQ(committed_frames(run_), 0);  // opens the run
}

TEST_F(LongRun, takes_a_checkpoint_when_asked_and_goes_on) {
  const pid_t process = start(long_deposition);
  pause(100);
  const std::string before = text_of(manifest_);
  ASSERT_EQ(io::RunFile::open(run_).checkpoint().world.step, 0);
  kill(process, SIGUSR1);
  EXPECT_TRUE(wait_until([&] { return text_of(manifest_) != before; }));
  EXPECT_TRUE(is_running(process));
  const io::RunFile run = io::RunFile::open(run_);
  EXPECT_GT(run.checkpoint().world.step, 0);
  EXPECT_EQ(run.all_frame_tilts().size(), 0u) << "a frame was the cause";
  end(process);
}

TEST_F(LongRun, says_that_its_folder_is_gone) {
  write_file(folder_, "bed.toml", "[bed]\nlength = 50\ndepth = 20\n[output]\ncheckpoint_every = 0\n");
  std::future<Outcome> running = std::async(std::launch::async, [this] {
    return folder_.talus({"run", "bed.toml", "-o", "run.h5", "--quiet"});
  });
  ASSERT_TRUE(wait_until([this] { return fs::exists(manifest_); }));
  fs::rename(run_ + ".run", run_ + ".moved.run");
  const Outcome outcome = running.get();
  EXPECT_TRUE(outcome.exit_code == 73 || outcome.exit_code == 74) << outcome.exit_code;
  EXPECT_TRUE(has(outcome.err, "run.h5.run"));
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
  EXPECT_FALSE(fs::exists(run_ + ".run"));
  EXPECT_GE(io::RunFile::open(folder_.path("run.h5.moved")).checkpoint().world.step, 0);
}

TEST_F(RunStops, of_two_writers_one_runs) {
  const int races = tries(4, 200);
  double longest = 0.0;
  for (int k = 0; k < races; ++k) {
    SCOPED_TRACE("race " + std::to_string(k));
    Words command = {"run", "bed.toml", "-o", "run.h5", "--threads", "1"};
    if (k % 2 == 1) {  // after a run that was killed and left its lock
      const pid_t killed = folder_.start(command);
      EXPECT_TRUE(wait_until([this] { return io::run_presence(run_) != io::RunPresence::none; }));
      kill(killed, SIGKILL);
      wait_for(killed);
      command.emplace_back("--resume");
    }
    for (int racer = 0; racer < 2; ++racer) folder_.start(command);
    const Clock::time_point start = Clock::now();
    std::multiset<int> codes;
    for (int racer = 0; racer < 2; ++racer) {
      int status = 0;
      waitpid(-1, &status, 0);
      codes.insert(WIFEXITED(status) ? WEXITSTATUS(status) : -1);
      if (*codes.rbegin() == 73 && codes.size() == 1) longest = std::max(longest, seconds_since(start));
    }
    EXPECT_EQ(codes, (std::multiset<int>{0, 73}));
    finish();
  }
  std::printf("%d races: the loser left within %.3f s\n", races, longest);
}

}  // namespace
}  // namespace talus::test
