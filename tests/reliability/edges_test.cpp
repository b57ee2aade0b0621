/// Environment of a command: signals, pipes, memory, user settings, terminal.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "base/errors.h"
#include "core/random.h"
#include "reliability/hostile_file.h"
#include "reliability/hostile_run.h"
#include "reliability/whole_run.h"
#include "session/run_check.h"
#include "session/run_header.h"
#include "session/session.h"
#include "support/commands.h"
#include "support/resource_limit.h"

namespace talus::test {
namespace {

namespace fs = std::filesystem;

constexpr double soon = 1.0;  // s
constexpr int stop_signals[] = {SIGINT, SIGTERM, SIGHUP};

/// A run and files made from it, shared by all tests.
class Edges : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new CommandFolder;
    hostile::make_run(folder->path("run.h5"));
    hostile::make_problem(folder->path("run.h5"), folder->path("problem.h5"));
    write_file(*folder, "bed.toml", short_bed);
  }
  static void TearDownTestSuite() {
    delete folder;
    folder = nullptr;
  }
  static Outcome talus(const Words& words, const Words& environment = {}) {
    return folder->talus(words, environment);
  }

  /// Returns the exit status of a command that receives a signal while it works; checks that it ends soon.
  static int end_by(const Words& words, int signal) {
    const pid_t process = folder->start(words);
    if (!wait_until_caught(process, SIGTERM)) return wait_for(process);  // it had already ended
    const auto begin = Clock::now();
    kill(process, signal);
    const bool ended = wait_until([process] { return has_ended(process); });
    EXPECT_LT(seconds_since(begin), soon + 1.0) << words[0] << " after signal " << signal;
    if (!ended) kill(process, SIGKILL);
    return wait_for(process);
  }

  static inline CommandFolder* folder = nullptr;
};

TEST_F(Edges, each_signal_ends_each_command) {
  const std::vector<Words> commands = {
      {"figures", "run.h5", "-o", "figures", "--overwrite"},
      {"panel", "run.h5", "--map", "pressure", "--at", "0,0.5,1", "-o", "panel.png", "--overwrite"},
      {"render", "run.h5", "--map", "pressure", "-o", "maps", "--overwrite"},
      {"animate", "run.h5", "--map", "pressure", "-o", "movie.mp4", "--overwrite"},
      {"solve", "problem.h5", "--cold", "--tol", "1e-15"},
      {"analyze", "run.h5"},
      {"check", "run.h5"},
      {"replay", "run.h5"}};
  for (const Words& words : commands)
    for (const int signal : stop_signals) {
      const int code = end_by(words, signal);
      EXPECT_TRUE(code == 75 || code == 0)
          << words[0] << " ended with " << code << " after signal " << signal << ": " << folder->errors();
      if (code == 75) {
        EXPECT_TRUE(has(folder->errors(), "topped")) << words[0];
        EXPECT_FALSE(has(folder->errors(), "error")) << words[0];
      }
    }
}

TEST_F(Edges, a_hangup_stops_a_run_with_a_checkpoint) {
  const pid_t process = folder->start({"run", "bed.toml", "-o", "hung.h5", "--threads", "1"});
  ASSERT_TRUE(wait_until([] { return folder->has_file("hung.h5.run/manifest"); }));
  kill(process, SIGHUP);
  EXPECT_EQ(wait_for(process), 75) << folder->errors();
  EXPECT_TRUE(has(folder->errors(), "Stopped at "));
  EXPECT_EQ(talus({"run", "--resume", "hung.h5", "-q"}).exit_code, 0);
}

TEST_F(Edges, a_pipe_that_nobody_writes_to_is_left_by_each_signal) {
  ASSERT_EQ(mkfifo(folder->path("pipe.toml").c_str(), 0600), 0);
  for (const char* command : {"run", "check"})
    for (const int signal : stop_signals) EXPECT_EQ(end_by({command, "pipe.toml"}, signal), 75) << command;
}

TEST_F(Edges, a_pipe_or_a_device_is_no_run_and_no_problem) {
  ASSERT_EQ(mkfifo(folder->path("pipe.h5").c_str(), 0600), 0);
  for (const char* file : {"pipe.h5", "/dev/tty", "/dev/zero"})
    for (const char* command : {"info", "analyze", "solve"}) {
      const auto begin = Clock::now();
      const pid_t process = folder->start({command, file});
      const bool ended = wait_until([process] { return has_ended(process); });
      if (!ended) kill(process, SIGKILL);
      EXPECT_EQ(wait_for(process), 66) << command << " " << file << folder->errors();
      EXPECT_LT(seconds_since(begin), soon + 1.0) << command;
    }
}

TEST_F(Edges, figures_that_are_stopped_leave_no_files_behind) {
  const auto has_part = [] {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder->path("slow"), none))
      if (entry.path().extension() == ".part") return true;
    return false;
  };
  const pid_t process = folder->start({"figures", "run.h5", "-o", "slow", "--overwrite"});
  ASSERT_TRUE(wait_until(has_part)) << folder->errors();
  kill(process, SIGTERM);
  EXPECT_EQ(wait_for(process), 75) << folder->errors();
  EXPECT_FALSE(has_part());
}

TEST_F(Edges, a_run_that_is_packed_while_it_is_checked_is_whole) {
  const std::string path = folder->path("left.h5");
  hostile::make_folder_of_run(path, 0.7);
  const io::RunFile run = io::RunFile::open(path);
  const std::size_t frames = run.all_frame_tilts().size(), steps = run.steps().size();
  ASSERT_GT(frames, 1u);
  ASSERT_EQ(talus({"run", "--resume", "left.h5", "-q"}).exit_code, 0);
  ASSERT_FALSE(fs::exists(path + ".run"));
  const session::RunCheck check = session::check_run(run, {});
  EXPECT_TRUE(check.faults.empty()) << check.faults.front();
  EXPECT_EQ(check.frames, frames);
  EXPECT_EQ(check.steps, steps);
}

std::string reported_by(const std::string& path) try {
  const session::RunCheck check = session::check_run(io::RunFile::open(path), {});
  return check.faults.empty() ? "" : check.faults.front();
} catch (const Error& error) {
  return error.what();
}

/// For a file that was changed and sealed again, `check` reports the change, or every value is unchanged.
/// TALUS_TRIES sets the number of tries.
TEST_F(Edges, a_value_changed_and_sealed_again_is_told_or_changes_nothing) {
  const hostile::Bytes good = hostile::read_bytes(folder->path("run.h5"));
  Words paths = hostile::data_sets(good);
  std::erase_if(paths, [](const std::string& data_set) { return data_set.starts_with("/help/"); });  // texts
  const std::uint64_t whole = hostile::values_hash(good);
  const std::string path = folder->path("changed.h5");
  ASSERT_EQ(reported_by(folder->path("run.h5")), "");
  const char* asked = std::getenv("TALUS_TRIES");
  const int count = asked != nullptr ? std::atoi(asked) : 100;
  int reported = 0;
  Random random(40);
  for (int k = 0; k < count; ++k) {
    const hostile::Spoil spoil = {paths[random.below(static_cast<std::uint32_t>(paths.size()))],
                                  hostile::Harm::one_value,
                                  random.next(),
                                  random.below(40),
                                  {}};
    const hostile::Bytes changed = hostile::spoilt(good, std::vector<hostile::Spoil>{spoil});
    hostile::write_bytes(path, changed);
    if (!reported_by(path).empty())
      ++reported;
    else
      EXPECT_EQ(hostile::values_hash(changed), whole)
          << spoil.path << " at " << spoil.index << ", " << spoil.bits;
  }
  std::printf("%d changes: %d reported, %d without effect\n", count, reported, count - reported);
}

constexpr rlim_t mebibyte = rlim_t{1} << 20;

TEST_F(Edges, a_bed_for_which_there_is_no_memory_is_refused_before_it_is_made) {
  const ResourceLimit limit(RLIMIT_AS, 4096 * mebibyte);
  EXPECT_TRUE(ends(
      talus({"run", "bed.toml", "--set", "bed.length=100000", "--set", "bed.depth=20", "-o", "large.h5"}), 71,
      {"this run needs up to about 1", "only 4.3 GB are available"}));
  EXPECT_FALSE(folder->has_file("large.h5.run"));
}

TEST_F(Edges, too_little_memory_to_draw_is_not_told_as_a_missing_library) {
  int drawn = 0, refused = 0;
  for (rlim_t size = 60; size <= 420; size += 40) {
    const ResourceLimit limit(RLIMIT_AS, size * mebibyte);
    const Outcome outcome =
        talus({"render", "run.h5", "--map", "pressure", "--at", "0", "-o", "small", "--overwrite"});
    if (outcome.exit_code == 127) continue;  // the system could not start it
    // A library may crash without memory.
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 71 || outcome.exit_code == -1)
        << size << " MiB: " << outcome.exit_code << outcome.err;
    drawn += outcome.exit_code == 0;
    refused += outcome.exit_code == 71;
  }
  EXPECT_GT(drawn, 0);
  EXPECT_GT(refused, 0);
}

TEST_F(Edges, no_text_of_a_file_reaches_the_terminal_raw) {
  const std::string attack =
      "\x1b]0;owned\a\x1b[2J\xc2\x9b"
      "31m\r\x7f";
  session::Session session(scenario::parse_scenario(tiny_bed, "tiny.toml"));
  io::RunHeader header = session::run_header(session, {});
  for (auto& [name, value] : header.provenance) value = attack;
  io::Checkpoint checkpoint = session.checkpoint(0.0);
  checkpoint.results.emplace_back("bad\x1b[31mname", 1.0);
  io::RunStore::create(folder->path("attack.h5"), header, false).commit({}, checkpoint);
  for (const Words& words : {Words{"info", "attack.h5"},
                             {"info", "attack.h5", "--json"},
                             {"check", "attack.h5"},
                             {"replay", "attack.h5"},
                             {"analyze", "attack.h5"}})
    expect_no_controls(talus(words));
  EXPECT_TRUE(has(talus({"info", "attack.h5"}).out, "\\x1b[2J"));
}

TEST_F(Edges, settings_of_the_user_change_no_figure) {
  write_file(*folder, "matplotlibrc", "lines.linewidth: 9\nfont.size: 20\n");
  const Words make = {"figures", "run.h5", "--only", "fig04", "--add", "svg", "--overwrite", "-o"};
  const auto figure = [&](const std::string& into, const Words& environment) {
    EXPECT_TRUE(ends(talus(make + Words{into}, environment), 0));
    return folder->text(into + "/fig04-shear-stress.svg");
  };
  const std::string usual = figure("usual", {"HOME=/nonexistent"});
  EXPECT_FALSE(usual.empty());
  const mode_t mask = umask(077);
  EXPECT_EQ(figure("own", {"HOME=" + folder->path().string(), "LC_ALL=de_DE.UTF-8", "LANG=C",
                           "MPLBACKEND=tkagg", "MATPLOTLIBRC=" + folder->path("matplotlibrc")}),
            usual);
  umask(mask);
}

TEST_F(Edges, a_seed_out_of_range_is_told_as_such) {
  for (const char* seed : {"-1", "99999999999999999999"}) {
    const Outcome outcome = talus({"run", "bed.toml", "--seed", seed, "-o", "none.h5"});
    EXPECT_EQ(outcome.exit_code, 65);
    EXPECT_EQ(outcome.err, std::string("--set seed=") + seed + ": error: key 'seed' = " + seed +
                               ": expected an integer in 0 ... 9223372036854775807\n");
  }
  EXPECT_EQ(talus({"run", "bed.toml", "--seed", "seven", "-o", "none.h5"}).exit_code, 64);
}

TEST_F(Edges, a_replay_that_was_killed_is_not_advised_to_resume) {
  hostile::make_folder_of_run(folder->path("part.h5"), 0.3);
  const Outcome outcome = talus({"replay", "run.h5", "-o", "part.h5"});
  EXPECT_TRUE(ends(outcome, 73, {"--overwrite"}));
  EXPECT_FALSE(has(outcome.err, "--resume"));
}

}  // namespace
}  // namespace talus::test
