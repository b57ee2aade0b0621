/// `talus reproduce` before its first run is complete: arguments, interruptions, foreign folders.
/// reproduce_slow_test.cpp has a complete reproduction, which takes minutes.

#include <gtest/gtest.h>

#include <csignal>
#include <thread>

#include "support/process.h"
#include "support/runs.h"

namespace talus::test {
namespace {

const char* const first_run = "quick/wbc-150/seed-1.h5";  // the longest run

pid_t start_quick(const TemporaryFolder& folder) {
  const pid_t process = start_talus({"reproduce", "--quick", "-o", "quick", "--jobs", "1"}, folder.path());
  const std::string manifest = folder.path(std::string(first_run) + ".run/manifest");
  for (int wait = 0; wait < 1000 && !std::filesystem::exists(manifest); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return process;
}

int steps_of_first_run(const TemporaryFolder& folder) {
  const std::string info = run_talus({"info", first_run, "--json"}, folder.path()).out;
  return std::stoi(std::string("0").append(json_value(info, "steps")));
}

TEST(Reproduce, of_a_bad_form_leaves_with_64_before_anything_is_written) {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& bad :
       {std::vector<std::string>{"--jobs", "-1"}, {"--seeds", "2-1"}, {"--seeds", "x"}, {"slope.toml"}}) {
    std::vector<std::string> arguments = {"reproduce", "--quick", "-o", "quick"};
    arguments.insert(arguments.end(), bad.begin(), bad.end());
    EXPECT_EQ(run_talus(arguments, folder.path()).exit_code, 64) << bad.front();
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path("quick")));
}

TEST(Reproduce, needs_matplotlib_before_anything_is_done) {
  const TemporaryFolder folder;
  write_file(folder, "matplotlib.py", "raise ImportError('No module named matplotlib', name='matplotlib')\n");
  const Outcome outcome = run_talus({"reproduce", "--quick", "-o", "quick"}, folder.path(),
                                    {"PYTHONPATH=" + folder.path().string()});
  EXPECT_EQ(outcome.exit_code, 69);
  EXPECT_NE(outcome.err.find("matplotlib"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("apt"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("quick")));
}

TEST(Reproduce, that_is_stopped_leaves_with_75_and_goes_on_where_it_was) {
  const TemporaryFolder folder;
  const pid_t first = start_quick(folder);
  for (int wait = 0; wait < 1000 && steps_of_first_run(folder) < 2; ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(first, SIGINT);
  EXPECT_EQ(wait_for(first), 75);
  const int steps = steps_of_first_run(folder);
  EXPECT_GT(steps, 1);
  const std::string lock = folder.path(std::string(first_run) + ".run/lock"), holder = text_of(lock);
  const pid_t second = start_quick(folder);
  const auto has_new_holder = [&] { return !text_of(lock).empty() && text_of(lock) != holder; };
  for (int wait = 0; wait < 1000 && !has_new_holder(); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(has_new_holder());
  kill(second, SIGTERM);
  EXPECT_EQ(wait_for(second), 75);
  EXPECT_GE(steps_of_first_run(folder), steps) << "it restarted";
  EXPECT_FALSE(std::filesystem::exists(folder.path("quick/report.html")));
}

TEST(Reproduce, begins_an_ensemble_that_others_may_compute) {
  const TemporaryFolder folder;
  const Outcome begun = run_talus({"reproduce", "--quick", "-o", "quick", "--jobs", "0"}, folder.path());
  EXPECT_EQ(begun.exit_code, 0) << begun.err;
  EXPECT_NE(begun.out.find("quick: 0 of 8 done"), std::string::npos) << begun.out;
  EXPECT_FALSE(std::filesystem::exists(folder.path("quick/report.html")));
  EXPECT_NE(text_of(folder.path("quick/ensemble.manifest")).find("task readings\n"), std::string::npos);
  EXPECT_EQ(run_talus({"check", "quick/scenarios/wbc-150.toml"}, folder.path()).exit_code, 0);
  const Outcome full = run_talus({"reproduce", "-o", "quick", "--jobs", "0"}, folder.path());
  EXPECT_EQ(full.exit_code, 65) << "another bed";
  EXPECT_NE(full.err.find("bed.depth is 20 there, 40 here"), std::string::npos) << full.err;
}

TEST(Reproduce, refuses_a_folder_with_another_run_in_it) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("quick/wbc-150"));
  take_run(folder, first_run, "[bed]\nlength = 10\ndepth = 4\n[tilt]\nend_angle = 0.5\n");
  const Outcome outcome = run_talus({"reproduce", "--quick", "-o", "quick"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 65);
  EXPECT_NE(outcome.err.find(first_run), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("quick/ensemble.manifest")));
}

}  // namespace
}  // namespace talus::test
