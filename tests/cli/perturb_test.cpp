/// `talus perturb` on a tiny bed: its runs, tables and figure, interruption and resumption.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <thread>

#include "io/run_file.h"
#include "support/places.h"
#include "support/process.h"
#include "support/runs.h"

namespace talus::test {
namespace {

/// Bed of 40 grains that is tilted to 20 deg in one second and remains stable.
const char* const tiny_bed = "[bed]\nlength = 10\ndepth = 4\n[tilt]\nend_angle = 20\n";

class Perturb : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_python_package()) GTEST_SKIP() << "the Python package was not built: python3-dev, pybind11-dev";
  }
};

std::vector<std::string> perturb(const std::string& folder, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {"perturb", "bed.toml", "-o", folder,    "--from",
                                    "8",       "--every",  "5",  "--patch", "4x1"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::string hash_of(const std::string& run, const TemporaryFolder& folder) {
  return json_value(run_talus({"info", run, "--json"}, folder.path()).out, "state_hash");
}

TEST_F(Perturb, leaves_the_run_as_it_is_without) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  take_run(folder, "plain.h5", tiny_bed, {"--seed", "2"});
  const Outcome outcome = run_talus(perturb("p", {"--seed", "2"}), folder.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(hash_of("plain.h5", folder), "");
  EXPECT_EQ(hash_of("p/seed-2.h5", folder), hash_of("plain.h5", folder));
  EXPECT_NE(text_of(folder.path("p/seed-2.log")).find("13.000 deg: no avalanche"), std::string::npos);
  const std::vector<TrialRow> trials = io::RunFile::open(folder.path("p/seed-2.h5")).trials();
  for (const double tilt : {8.0, 13.0, 18.0})
    EXPECT_TRUE(std::ranges::any_of(trials, [&](const TrialRow& row) {
      return at(row, TrialField::tilt) == tilt && at(row, TrialField::velocity) == 0.0 &&
             at(row, TrialField::end) == 0.0;
    })) << tilt;
  EXPECT_TRUE(
      std::ranges::any_of(trials, [](const TrialRow& row) { return at(row, TrialField::velocity) == 5.0; }));
  EXPECT_NE(
      run_talus({"info", "p/seed-2.h5", "--json"}, folder.path()).out.find("--from 8 --every 5 --patch 4x1"),
      std::string::npos);
}

TEST_F(Perturb, of_a_programme_pushes_a_tilt_once_that_is_held_and_comes_back) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml",
             "[bed]\nlength = 10\ndepth = 4\n[tilt]\nrate = 4\nstep = 0.004\n"
             "program = [\"to 8 deg\", \"hold 0.1 s\", \"to 6 deg\", \"to 9 deg\"]\n");
  const Outcome outcome = run_talus(perturb("p", {"--seed", "1"}), folder.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<TrialRow> trials = io::RunFile::open(folder.path("p/seed-1.h5")).trials();
  EXPECT_EQ(
      std::ranges::count_if(trials, [](const TrialRow& row) { return at(row, TrialField::velocity) == 0.0; }),
      1);
}

TEST_F(Perturb, reports_its_seeds_and_computes_none_again) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  const Outcome first = run_talus(perturb("p", {"--seeds", "1-2"}), folder.path());
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(first.out, text_of(folder.path("p/perturb.md")));
  EXPECT_NE(first.out.find("6 states of 2 runs"), std::string::npos) << first.out;
  const std::string rows = text_of(folder.path("p/perturb.csv"));
  EXPECT_EQ(std::ranges::count(rows, '\n'), 7) << rows;
  const auto written = std::filesystem::last_write_time(folder.path("p/seed-1.h5"));
  const Outcome again = run_talus(perturb("p", {"--seeds", "1-2"}), folder.path());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out, first.out);
  EXPECT_EQ(std::filesystem::last_write_time(folder.path("p/seed-1.h5")), written);
}

TEST_F(Perturb, says_so_where_no_copy_was_pushed) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  const Outcome outcome =
      run_talus({"perturb", "bed.toml", "-o", "p", "--from", "30", "--seeds", "1"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 65);
  EXPECT_NE(
      outcome.err.find("of at least 30 deg (--from) was reached before failure, and none of the beds failed"),
      std::string::npos)
      << outcome.err;
}

TEST_F(Perturb, draws_its_figure_where_there_is_matplotlib) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  std::filesystem::create_directory(folder.path("without"));
  write_file(folder, "without/matplotlib.py",
             "raise ModuleNotFoundError(\"No module named 'matplotlib'\", name='matplotlib')\n");
  const Outcome without =
      run_talus(perturb("p", {"--seeds", "1"}), folder.path(), {"PYTHONPATH=" + folder.path("without")});
  ASSERT_EQ(without.exit_code, 0) << without.err;
  EXPECT_NE(without.err.find("warning: the figure is left out"), std::string::npos) << without.err;
  EXPECT_NE(without.err.find("python3-matplotlib"), std::string::npos) << without.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("p/perturb.pdf")));
  const Outcome outcome = run_talus(perturb("p", {"--seeds", "1"}), folder.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* drawn : {"perturb.pdf", "perturb.svg", "perturb.png", "perturb.json"})
    EXPECT_TRUE(std::filesystem::exists(folder.path("p") + "/" + drawn)) << drawn << outcome.err;
}

TEST_F(Perturb, says_what_to_install_before_anything_is_done) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  std::filesystem::create_directory(folder.path("without"));
  write_file(folder, "without/numpy.py",
             "raise ModuleNotFoundError(\"No module named 'numpy'\", name='numpy')\n");
  const Outcome outcome =
      run_talus(perturb("p", {"--seeds", "1"}), folder.path(), {"PYTHONPATH=" + folder.path("without")});
  EXPECT_EQ(outcome.exit_code, 69);
  EXPECT_EQ(outcome.err,
            "talus: error: this command needs the Python module numpy: apt-get install python3-numpy\n");
  EXPECT_FALSE(std::filesystem::exists(folder.path("p")));
}

// The package is looked for next to the program.
TEST_F(Perturb, without_the_package_says_so) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  std::filesystem::copy_file(talus_program(), folder.path("talus"));
  const std::string command = "cd " + folder.path().string() + " && ./talus perturb bed.toml -o p 2> said";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 69);
  EXPECT_NE(text_of(folder.path("said")).find("needs the Python package talus, which was not installed with"),
            std::string::npos)
      << text_of(folder.path("said"));
}

class InterruptedPerturb : public Perturb, public testing::WithParamInterface<int> {};

TEST_P(InterruptedPerturb, goes_on_to_the_same_table) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(perturb("whole", {"--seed", "1"}), folder.path()).exit_code, 0);
  const std::vector<int> codes = stop_until_done(
      [&] {
        return start_talus(perturb("parts", {"--seed", "1"}), folder.path());
      },
      GetParam(), 200, folder.path("parts"));
  // The signal may arrive before the program handles it.
  for (const int code : codes)
    EXPECT_TRUE(code == 0 || code == -1 || (code == 75 && GetParam() != SIGKILL))
        << code << errors_in(folder.path());
  EXPECT_EQ(codes.back(), 0);
  EXPECT_EQ(hash_of("parts/seed-1.h5", folder), hash_of("whole/seed-1.h5", folder));
  EXPECT_EQ(io::RunFile::open(folder.path("parts/seed-1.h5")).trials(),
            io::RunFile::open(folder.path("whole/seed-1.h5")).trials());
}

INSTANTIATE_TEST_SUITE_P(Signals, InterruptedPerturb, testing::Values(SIGTERM, SIGKILL));

// Trials are committed together with the state at which they were made.
TEST_F(Perturb, pushes_no_copy_again_whose_trials_are_stored) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  const std::string log = folder.path("p/seed-1.log");
  const auto count_of_states = [&] {
    const std::string said = std::filesystem::exists(log) ? text_of(log) : "";
    std::size_t count = 0;
    for (std::size_t k = said.find(" deg: "); k != std::string::npos; k = said.find(" deg: ", k + 1)) ++count;
    return count;
  };
  const pid_t process = start_talus(perturb("p", {"--seed", "1"}), folder.path());
  for (int wait = 0; wait < 10000 && count_of_states() == 0; ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  kill(process, SIGKILL);
  wait_for(process);
  EXPECT_EQ(run_talus(perturb("p", {"--seed", "1"}), folder.path()).exit_code, 0);
  EXPECT_EQ(count_of_states(), 3u) << text_of(log);
}

TEST_F(Perturb, that_is_stopped_stops_its_seeds) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", "[bed]\nlength = 50\ndepth = 20\n");
  const pid_t process = start_talus(perturb("p", {"--seeds", "1-2"}), folder.path());
  for (int wait = 0; wait < 1000 && !std::filesystem::exists(folder.path("p/seed-1.h5.run/manifest")); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(process, SIGINT);
  EXPECT_EQ(wait_for(process), 75);
  EXPECT_FALSE(std::filesystem::exists(folder.path("p/perturb.md")));
}

TEST_F(Perturb, of_a_bad_form_leaves_with_64_before_anything_runs) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"perturb", "bed.toml"},
           {"perturb", "bed.toml", "-o", "p", "--patch", "10"},
           {"perturb", "bed.toml", "-o", "p", "--patch", "0x2"},
           {"perturb", "bed.toml", "-o", "p", "--every", "0"},
           {"perturb", "bed.toml", "-o", "p", "--seeds", "4-1"},
           {"perturb", "bed.toml", "-o", "p", "--seeds", "1", "--seed", "1"}})
    EXPECT_EQ(run_talus(words, folder.path()).exit_code, 64) << words.back();
  EXPECT_EQ(run_talus({"perturb", "bed.toml", "-o", "p", "--set", "tilt.stp=1"}, folder.path()).exit_code,
            65);
  EXPECT_FALSE(std::filesystem::exists(folder.path("p")));
}

TEST_F(Perturb, does_not_mix_plans_or_scenarios_in_a_folder) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(perturb("p", {"--seed", "1"}), folder.path()).exit_code, 0);
  const Outcome plan = run_talus({"perturb", "bed.toml", "-o", "p", "--seeds", "1"}, folder.path());
  EXPECT_EQ(plan.exit_code, 65);
  EXPECT_NE(plan.err.find("have the task 'trials --from 8 --every 5 --patch 4x1'"), std::string::npos)
      << plan.err;
  const Outcome scenario =
      run_talus(perturb("p", {"--seed", "1", "--set", "contact.friction=0.3"}), folder.path());
  EXPECT_EQ(scenario.exit_code, 65);
  EXPECT_NE(scenario.err.find("contact.friction is 0.5 there, 0.3 here"), std::string::npos) << scenario.err;
}

TEST_F(Perturb, takes_no_run_that_lacks_its_trials) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  std::filesystem::create_directory(folder.path("p"));
  take_run(folder, "p/seed-1.h5", tiny_bed);
  const Outcome missing = run_talus(perturb("p", {"--seed", "1"}), folder.path());
  EXPECT_EQ(missing.exit_code, 65);
  EXPECT_NE(missing.err.find("has the trials 'none', expected '--from 8 --every 5 --patch 4x1'"),
            std::string::npos)
      << missing.err;
  EXPECT_EQ(run_talus(perturb("p", {"--seed", "2"}), folder.path()).exit_code, 0) << "another seed";
  std::filesystem::remove(folder.path("p/seed-1.h5"));
  EXPECT_EQ(run_talus(perturb("p", {"--seed", "1"}), folder.path()).exit_code, 0);
}

TEST_F(Perturb, of_one_seed_computes_no_other_and_is_an_ensemble_that_others_may_compute) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  const Outcome begun = run_talus(perturb("p", {"--seeds", "1-3", "--jobs", "0"}), folder.path());
  EXPECT_EQ(begun.exit_code, 0) << begun.err;
  EXPECT_NE(begun.out.find("p: 0 of 3 done"), std::string::npos) << begun.out;
  const pid_t side_by_side = start_talus(perturb("p", {"--seed", "2"}), folder.path());
  EXPECT_EQ(run_talus(perturb("p", {"--seed", "2"}), folder.path()).exit_code, 0) << "it waits";
  EXPECT_TRUE(std::filesystem::exists(folder.path("p/seed-2.h5")));
  EXPECT_EQ(wait_for(side_by_side), 0);
  for (const char* other : {"p/seed-1.h5", "p/seed-3.h5", "p/perturb.md"})
    EXPECT_FALSE(std::filesystem::exists(folder.path(other))) << other;
  ASSERT_EQ(run_talus({"ensemble", "work", "p"}, folder.path()).exit_code, 0);
  const Outcome report = run_talus(perturb("p", {"--seeds", "1-3", "--jobs", "0"}), folder.path());
  EXPECT_EQ(report.exit_code, 0) << report.err;
  EXPECT_NE(report.out.find("9 states of 3 runs"), std::string::npos) << report.out;
}

}  // namespace
}  // namespace talus::test
