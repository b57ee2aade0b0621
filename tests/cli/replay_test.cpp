/// `talus replay`, the commands listed by `talus info`, and runs in tests/runs.

#include <gtest/gtest.h>

#include <csignal>

#include "core/trigonometry.h"
#include "io/run_file.h"
#include "io/run_schema.h"
#include "session/run.h"
#include "session/run_header.h"
#include "support/commands.h"
#include "support/places.h"
#include "support/runs.h"

namespace talus::test {
namespace {

const char* const small_bed =
    "[bed]\nlength = 10\ndepth = 3\n[deposition]\nmethod = \"collapse\"\nrest_velocity = 0.1\n"
    "[tilt]\nrate = 20\nstep = 0.02\nend_angle = 4\n[output]\nframe_every = 0.5\nobservable_every = 0.2\n";

class Replay : public CommandTest {
 protected:
  /// Writes an unfinished run of the small bed with a push during its fall and commands at 1.06 deg, between
  /// two rows of observables.
  void write_left_run() {
    write_file(folder_, "bed.toml", small_bed);
    session::Session session(scenario::parse_scenario(small_bed, "bed.toml"));
    io::RunStore store = io::RunStore::create(
        folder_.path("bed.h5"), session::run_header(session, {small_bed, "bed.toml", {}, 1}), false);
    for (int k = 0; k < 10; ++k) session.advance();
    session.apply({0, CommandKind::push, 7, 0.25, 0.5});
    while (session.world().tilt < radians(1.05)) session.advance();
    session.apply({0, CommandKind::drop, 4, 0.05, 0.02});
    session.apply({0, CommandKind::friction, -1, 0.3, 0.0});
    session.apply({0, CommandKind::tilt_rate, -1, 10.0, 0.0});
    store.commit(session.segment(), session.checkpoint(0.0));
  }
};

TEST_F(Replay, of_a_plain_run_finds_its_end) {
  take_run(folder_, "bed.h5", small_bed);
  const std::string hash = folder_.hash("bed.h5");
  EXPECT_TRUE(ends(talus({"replay", "bed.h5"}), 0, {"stored      " + hash, "recomputed  " + hash}));
  EXPECT_EQ(info("bed.h5", "commands"), "0");
  EXPECT_FALSE(has(talus({"info", "bed.h5"}).out, "commands"));
  EXPECT_EQ(talus({"replay", "bed.h5", "--quiet"}).out, "");
}

TEST_F(Replay, of_a_run_with_commands_that_was_left_and_resumed_finds_its_end) {
  write_left_run();
  EXPECT_TRUE(ends(talus({"replay", "bed.h5"}), 0));
  ASSERT_EQ(talus({"run", "bed.toml", "-o", "bed.h5", "--resume"}).exit_code, 0);
  EXPECT_EQ(info("bed.h5", "complete"), "true");
  EXPECT_TRUE(ends(talus({"replay", "bed.h5", "-o", "again.h5"}), 0));
  for (const char* key : {"complete", "commands", "state_hash", "steps", "frames"})
    EXPECT_EQ(info("again.h5", key), info("bed.h5", key)) << key;
  EXPECT_EQ(talus({"replay", "again.h5"}).exit_code, 0);
}

TEST_F(Replay, keeps_a_run_that_was_left_as_one_that_can_be_resumed) {
  write_left_run();
  ASSERT_EQ(talus({"replay", "bed.h5", "-o", "again.h5"}).exit_code, 0);
  EXPECT_EQ(info("again.h5", "complete"), "false");
  for (const char* run : {"bed.h5", "again.h5"})
    ASSERT_EQ(talus({"run", "bed.toml", "-o", run, "--resume"}).exit_code, 0);
  EXPECT_EQ(folder_.hash("again.h5"), folder_.hash("bed.h5"));
}

TEST_F(Replay, commands_are_listed) {
  write_left_run();
  EXPECT_TRUE(has_all(talus({"info", "bed.h5"}).out,
                      {"commands            4\n", "deposition   push grain 7 by (0.25, 0.5) m/s\n",
                       "1.060 deg    drop 4 grains at x = 0.05 m from 0.02 m above the surface\n",
                       "1.060 deg    friction 0.3\n", "1.060 deg    tilt rate 10 deg/s\n"}));
  EXPECT_EQ(info("bed.h5", "commands"), "4");
}

/// A run whose stored scenario is not the one from which it was computed.
TEST_F(Replay, that_finds_another_end_says_so) {
  const scenario::Scenario scenario = scenario::parse_scenario(small_bed, "bed.toml");
  session::Session session(scenario);
  io::RunHeader header = session::run_header(session, {small_bed, "bed.toml", {}, 1});
  scenario::Scenario other = scenario;
  other.contact.restitution = 0.5;
  header.scenario_resolved = scenario::resolved_toml(other);
  io::RunStore store = io::RunStore::create(folder_.path("bed.h5"), header, false);
  for (int k = 0; k < 100; ++k) session.advance();
  store.commit(session.segment(), session.checkpoint(0.0));
  EXPECT_TRUE(ends(talus({"replay", "bed.h5", "--quiet"}), 70, {"an end state that differs"}));
}

TEST_F(Replay, of_nothing_and_over_what_exists_is_refused) {
  write_left_run();
  write_file(folder_, "other.h5", "precious");
  EXPECT_EQ(talus({"replay", "bed.h5", "-o", "other.h5"}).exit_code, 73);
  EXPECT_EQ(talus({"replay", "bed.h5", "--overwrite"}).exit_code, 64);
  EXPECT_EQ(talus({"replay", "bed.h5", "-o", "./bed.h5", "--overwrite"}).exit_code, 64);
  EXPECT_EQ(talus({"replay", "bed.h5"}).exit_code, 0) << "it still exists";
}

/// A run whose tilt is held, and which claims more steps than can be replayed.
TEST_F(Replay, stops_when_asked) {
  session::Session session(scenario::parse_scenario(small_bed, "bed.toml"));
  io::RunStore store = io::RunStore::create(folder_.path("bed.h5"), session::run_header(session, {}), false);
  session.apply({0, CommandKind::tilt_rate, -1, 0.0, 0.0});
  io::Checkpoint checkpoint = session.checkpoint(0.0);
  checkpoint.world.step = 1'000'000'000;
  store.commit(session.segment(), checkpoint);
  const pid_t process = folder_.start({"replay", "bed.h5"});
  EXPECT_TRUE(wait_until_caught(process, SIGINT));
  kill(process, SIGINT);
  EXPECT_EQ(wait_for(process), 75);
}

/// Resuming it as a run would omit the commands that were not yet applied.
TEST_F(Replay, that_was_stopped_is_not_resumed_as_a_run) {
  write_left_run();
  {
    const io::RunFile run = io::RunFile::open(folder_.path("bed.h5"));
    session::Session session(scenario::parse_scenario(small_bed, "bed.toml"));
    io::RunHeader header = session::run_header(session, {small_bed, "bed.toml", {}, 1});
    header.provenance.emplace_back("replay_of", "bed.h5");
    header.provenance.emplace_back("replay_steps", std::to_string(run.checkpoint().world.step));
    io::RunStore store = io::RunStore::create(folder_.path("part.h5"), header, false);
    session::replay(session, &store, run.commands(), 30, {});
  }
  EXPECT_TRUE(ends(talus({"run", "bed.toml", "-o", "part.h5", "--resume"}), 65,
                   {"talus replay bed.h5 -o part.h5 --overwrite"}));
  ASSERT_EQ(talus({"replay", "bed.h5", "-o", "part.h5", "--overwrite"}).exit_code, 0);
  EXPECT_EQ(talus({"run", "bed.toml", "-o", "part.h5", "--resume"}).exit_code, 0) << "now it has all of them";
}

const std::filesystem::path kept_runs = std::filesystem::path(source_folder()) / "tests/runs";

const std::string schema = "schema_" + std::to_string(io::run_schema_version);

Outcome succeed(const Words& arguments, const CommandFolder& folder) {
  Outcome outcome = folder.talus(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << arguments.front() << " " << arguments.back() << ": " << outcome.err;
  return outcome;
}

class KeptRun : public testing::TestWithParam<std::string> {
 protected:
  std::string kept_run() const { return (kept_runs / (GetParam() + ".h5")).string(); }

  const CommandFolder folder_{};
};

// HDF5 1.10 of Debian 12, and its versions of Debian 13 and of testing.
INSTANTIATE_TEST_SUITE_P(WrittenUnder, KeptRun,
                         testing::Values(schema, schema + "_hdf5_1.14", schema + "_hdf5_2.2"));

TEST_P(KeptRun, opens_in_every_command) {
  ASSERT_TRUE(std::filesystem::exists(kept_run()))
      << "each version of the schema keeps a small run (docs/file_format.md, Versions)";
  const std::string run = folder_.path("run.h5");
  std::filesystem::copy_file(kept_run(), run);
  succeed({"check", run}, folder_);
  succeed({"analyze", run, "--quiet"}, folder_);
  succeed({"render", run, "--map", "gamma", "-o", "maps", "--set", "gamma_c=0.342"}, folder_);
  succeed({"replay", run}, folder_);
  EXPECT_EQ(json_value(succeed({"info", "--json", run}, folder_).out, "frames"), "5");
}

TEST_P(KeptRun, that_was_stopped_goes_on_to_the_same_end) {
  const std::string run = folder_.path("run.h5");
  std::filesystem::copy(kept_runs / (GetParam() + "_stopped.h5.run"), run + ".run");
  succeed({"check", run}, folder_);
  EXPECT_TRUE(has(succeed({"run", "--quiet", "--resume", run}, folder_).err, "was started by version"));
  EXPECT_EQ(folder_.hash(run), folder_.hash(kept_run()));
  succeed({"check", run}, folder_);
}

}  // namespace
}  // namespace talus::test
