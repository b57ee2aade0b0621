/// Studies of a tiny bed: their runs, tables, interruption and resumption.

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "support/commands.h"
#include "support/runs.h"

namespace talus::test {
namespace {

Words study_of(const std::string& folder) {
  return {"study",   "bed.toml",
          "--vary",  "tilt.rate:tilt.step=2:0.002",
          "--vary",  "solver.tolerance=1e-5",
          "--seeds", "1-2",
          "-o",      folder};
}
/// Some of its runs, with the arguments of `talus run` that produce the same.
const std::pair<const char*, Words> runs[] = {
    {"baseline/seed-1", {}},
    {"baseline/seed-2", {"--seed", "2"}},
    {"tilt.rate=2,tilt.step=0.002/seed-1", {"--set", "tilt.rate=2", "--set", "tilt.step=0.002"}},
    {"solver.tolerance=1e-05/seed-2", {"--seed", "2", "--set", "solver.tolerance=1e-5"}}};

using Study = StableBedTest;

TEST_F(Study, runs_have_the_bits_of_talus_run) {
  ASSERT_TRUE(ends(talus(study_of("study")), 0));
  for (const auto& [run, arguments] : runs)
    EXPECT_EQ(folder_.hash(std::string("study/") + run + ".h5"),
              folder_.hash(kept_run(stable_bed, arguments).string()))
        << run;
  EXPECT_NE(folder_.hash("study/baseline/seed-1.h5"), folder_.hash("study/baseline/seed-2.h5"));
}

/// Starts a study of one run that would take a minute, and returns once the run has committed something.
pid_t start_long_study(const CommandFolder& folder) {
  write_file(folder, "long.toml", "[bed]\nlength = 50\ndepth = 20\n[output]\ncheckpoint_every = 0\n");
  const std::string manifest = folder.path("long/baseline/seed-1.h5.run/manifest");
  std::error_code none;  // for a study that has not begun
  const auto before = std::filesystem::last_write_time(manifest, none);
  const pid_t process = folder.start({"study", "long.toml", "--seeds", "1", "-o", "long", "--jobs", "1"});
  wait_until([&] { return std::filesystem::last_write_time(manifest, none) != before; });
  return process;
}

int steps_of_long_run(const CommandFolder& folder) {
  return std::stoi(std::string("0") + folder.info("long/baseline/seed-1.h5", "steps"));
}

TEST_F(Study, that_is_stopped_stops_its_runs_and_goes_on_where_they_were) {
  const CommandFolder folder;
  const pid_t first = start_long_study(folder);
  wait_until([&] { return steps_of_long_run(folder) >= 10; });
  const auto asked = Clock::now();
  kill(first, SIGTERM);
  EXPECT_EQ(wait_for(first), 75);
  ASSERT_LT(seconds_since(asked), 10.0);
  const int steps = steps_of_long_run(folder);
  EXPECT_GT(steps, 1);
  const pid_t second = start_long_study(folder);
  kill(second, SIGTERM);
  EXPECT_EQ(wait_for(second), 75);
  EXPECT_GE(steps_of_long_run(folder), steps);
}

TEST_F(Study, that_is_killed_leaves_no_run_behind) {
  const CommandFolder folder;
  const pid_t study = start_long_study(folder);
  std::ifstream lock(folder.path("long/baseline/seed-1.h5.run/lock"));
  std::string word, writer;
  lock >> word >> writer;  // "process 123 on host ..."
  const std::string its_arguments = std::string("/proc/").append(writer).append("/cmdline");
  ASSERT_FALSE(text_of(its_arguments).empty()) << "process '" << writer << "'";
  kill(study, SIGKILL);
  wait_for(study);
  wait_until([&] { return text_of(its_arguments).empty(); });
  EXPECT_EQ(text_of(its_arguments), "");
}

TEST_F(Study, takes_runs_that_are_there_and_no_run_of_another_scenario) {
  std::filesystem::create_directories(folder_.path("study/baseline"));
  const std::string run = "study/baseline/seed-1.h5";
  take_run(folder_, run, stable_bed, {"--seed", "1"});
  EXPECT_TRUE(
      ends(talus({"study", "bed.toml", "--seeds", "1", "-o", "study", "--set", "contact.friction=0.3"}), 65,
           {run}));
  EXPECT_FALSE(folder_.has_file("study/ensemble.manifest")) << "nothing has begun";
  const std::string before = folder_.hash(run);
  EXPECT_TRUE(ends(talus({"study", "bed.toml", "--seeds", "1", "-o", "study"}), 0));
  EXPECT_EQ(folder_.hash(run), before);
  EXPECT_FALSE(has(folder_.text("study/baseline/seed-1.log"), "deposition"));
}

TEST_F(Study, is_an_ensemble_that_others_may_compute) {
  const Words begin = study_of("study") + Words{"--jobs", "0"};
  EXPECT_TRUE(ends(talus(begin), 0, {"study: 0 of 6 done"}));
  EXPECT_FALSE(folder_.has_file("study/study.md"));
  ASSERT_EQ(talus({"ensemble", "work", "study"}).exit_code, 0);
  EXPECT_TRUE(has(talus({"ensemble", "status", "study"}).out, "study: 6 of 6 done"));
  const Outcome study = talus(begin);
  EXPECT_TRUE(ends(study, 0, {"6 of 6 runs complete"}));
  EXPECT_EQ(study.err, "");
  EXPECT_EQ(count_of(folder_.text("study/members.csv"), "\n"), 7u);
}

TEST_F(Study, compares_what_is_complete_where_a_run_fails) {
  const Outcome study =
      talus({"study", "bed.toml", "--vary", "deposition.max_time=0.05", "--seeds", "1", "-o", "study"});
  EXPECT_TRUE(ends(study, 65, {"deposition.max_time=0.05/seed-1.log"}));
  EXPECT_TRUE(has(folder_.text("study/deposition.max_time=0.05/seed-1.log"), "did not come to rest"));
  EXPECT_TRUE(has(study.out, "1 of 2 runs complete"));
  EXPECT_TRUE(has(talus({"ensemble", "status", "study"}).out,
                  "failed: deposition.max_time=0.05/seed-1, exit code 65"));
}

}  // namespace
}  // namespace talus::test
