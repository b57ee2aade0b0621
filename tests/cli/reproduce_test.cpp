/// `talus reproduce` before its first run is complete: arguments, interruptions, foreign folders.
/// reproduce_slow_test.cpp has a complete reproduction, which takes minutes.

#include <gtest/gtest.h>

#include <csignal>

#include "support/commands.h"
#include "support/runs.h"

namespace talus::test {
namespace {

const char* const first_run = "quick/wbc-150/seed-1.h5";  // the longest run

pid_t start_quick(const CommandFolder& folder) {
  const pid_t process = folder.start({"reproduce", "--quick", "-o", "quick", "--jobs", "1"});
  const std::string manifest = folder.path(std::string(first_run) + ".run/manifest");
  wait_until([&] { return std::filesystem::exists(manifest); });
  return process;
}

int steps_of_first_run(const CommandFolder& folder) {
  const std::string info = folder.talus({"info", first_run, "--json"}).out;
  return std::stoi(std::string("0").append(json_value(info, "steps")));
}

using Reproduce = CommandTest;

TEST_F(Reproduce, of_a_bad_form_leaves_with_64_before_anything_is_written) {
  for (const Words& bad : {Words{"--jobs", "-1"}, {"--seeds", "2-1"}, {"--seeds", "x"}, {"slope.toml"}}) {
    Words arguments = Words{"reproduce", "--quick", "-o", "quick"} + bad;
    EXPECT_EQ(talus(arguments).exit_code, 64) << bad.front();
  }
  EXPECT_FALSE(folder_.has_file("quick"));
}

TEST_F(Reproduce, that_is_stopped_leaves_with_75_and_goes_on_where_it_was) {
  const pid_t first = start_quick(folder_);
  wait_until([&] { return steps_of_first_run(folder_) >= 2; });
  kill(first, SIGINT);
  EXPECT_EQ(wait_for(first), 75);
  const int steps = steps_of_first_run(folder_);
  EXPECT_GT(steps, 1);
  const std::string lock = folder_.path(std::string(first_run) + ".run/lock"), holder = text_of(lock);
  const pid_t second = start_quick(folder_);
  const auto has_new_holder = [&] { return !text_of(lock).empty() && text_of(lock) != holder; };
  wait_until([&] { return has_new_holder(); });
  EXPECT_TRUE(has_new_holder());
  kill(second, SIGTERM);
  EXPECT_EQ(wait_for(second), 75);
  EXPECT_GE(steps_of_first_run(folder_), steps) << "it restarted";
  EXPECT_FALSE(folder_.has_file("quick/report.html"));
}

TEST_F(Reproduce, begins_an_ensemble_that_others_may_compute) {
  EXPECT_TRUE(ends(talus({"reproduce", "--quick", "-o", "quick", "--jobs", "0"}), 0, {"quick: 0 of 8 done"}));
  EXPECT_FALSE(folder_.has_file("quick/report.html"));
  EXPECT_TRUE(has(folder_.text("quick/ensemble.manifest"), "\"task\": \"readings\""));
  EXPECT_EQ(talus({"check", "quick/scenarios/wbc-150.toml"}).exit_code, 0);
  EXPECT_TRUE(
      ends(talus({"reproduce", "-o", "quick", "--jobs", "0"}), 65, {"bed.depth is 20 there, 40 here"}))
      << "another bed";
}

TEST_F(Reproduce, refuses_a_folder_with_another_run_in_it) {
  std::filesystem::create_directories(folder_.path("quick/wbc-150"));
  take_run(folder_, first_run, "[bed]\nlength = 10\ndepth = 4\n[tilt]\nend_angle = 0.5\n");
  EXPECT_TRUE(ends(talus({"reproduce", "--quick", "-o", "quick"}), 65, {first_run}));
  EXPECT_FALSE(folder_.has_file("quick/ensemble.manifest"));
}

}  // namespace
}  // namespace talus::test
