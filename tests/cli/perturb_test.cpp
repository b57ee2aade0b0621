/// `talus perturb` on a tiny bed: its runs, tables and figure, interruption and resumption.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <thread>

#include "io/run_file.h"
#include "support/commands.h"
#include "support/places.h"
#include "support/runs.h"

namespace talus::test {
namespace {

/// Bed of 40 grains that is tilted to 20 deg in one second and remains stable.
const char* const tiny_bed = "[bed]\nlength = 10\ndepth = 4\n[tilt]\nend_angle = 20\n";

class Perturb : public CommandTest {
 protected:
  Perturb() : CommandTest(tiny_bed) {}

  void SetUp() override {
    if (!has_python_package()) GTEST_SKIP() << "the Python package was not built: python3-dev, pybind11-dev";
  }
};

Words perturb(const std::string& folder, const Words& more = {}) {
  return Words{"perturb", "bed.toml", "-o", folder, "--from", "8", "--every", "5", "--patch", "4x1"} + more;
}

TEST_F(Perturb, leaves_the_run_as_it_is_without) {
  take_run(folder_, "plain.h5", tiny_bed, {"--seed", "2"});
  ASSERT_TRUE(ends(talus(perturb("p", {"--seed", "2"})), 0));
  EXPECT_NE(folder_.hash("plain.h5"), "");
  EXPECT_EQ(folder_.hash("p/seed-2.h5"), folder_.hash("plain.h5"));
  EXPECT_TRUE(has(folder_.text("p/seed-2.log"), "13.000 deg: no avalanche"));
  const std::vector<TrialRow> trials = io::RunFile::open(folder_.path("p/seed-2.h5")).trials();
  for (const double tilt : {8.0, 13.0, 18.0})
    EXPECT_TRUE(std::ranges::any_of(trials, [&](const TrialRow& row) {
      return at(row, TrialField::tilt) == tilt && at(row, TrialField::velocity) == 0.0 &&
             at(row, TrialField::end) == 0.0;
    })) << tilt;
  EXPECT_TRUE(
      std::ranges::any_of(trials, [](const TrialRow& row) { return at(row, TrialField::velocity) == 5.0; }));
  EXPECT_TRUE(has(talus({"info", "p/seed-2.h5", "--json"}).out, "--from 8 --every 5 --patch 4x1"));
}

TEST_F(Perturb, of_a_programme_pushes_a_tilt_once_that_is_held_and_comes_back) {
  const CommandFolder folder(
      "[bed]\nlength = 10\ndepth = 4\n[tilt]\nrate = 4\nstep = 0.004\n"
      "program = [\"to 8 deg\", \"hold 0.1 s\", \"to 6 deg\", \"to 9 deg\"]\n");
  ASSERT_TRUE(ends(folder.talus(perturb("p", {"--seed", "1"})), 0));
  const std::vector<TrialRow> trials = io::RunFile::open(folder.path("p/seed-1.h5")).trials();
  EXPECT_EQ(
      std::ranges::count_if(trials, [](const TrialRow& row) { return at(row, TrialField::velocity) == 0.0; }),
      1);
}

TEST_F(Perturb, reports_its_seeds_and_computes_none_again) {
  const Outcome first = talus(perturb("p", {"--seeds", "1-2"}));
  ASSERT_TRUE(ends(first, 0, {"6 states of 2 runs"}));
  EXPECT_EQ(first.out, folder_.text("p/perturb.md"));
  const std::string rows = folder_.text("p/perturb.csv");
  EXPECT_EQ(std::ranges::count(rows, '\n'), 7) << rows;
  const auto written = std::filesystem::last_write_time(folder_.path("p/seed-1.h5"));
  const Outcome again = talus(perturb("p", {"--seeds", "1-2"}));
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out, first.out);
  EXPECT_EQ(std::filesystem::last_write_time(folder_.path("p/seed-1.h5")), written);
}

TEST_F(Perturb, says_so_where_no_copy_was_pushed) {
  EXPECT_TRUE(ends(talus({"perturb", "bed.toml", "-o", "p", "--from", "30", "--seeds", "1"}), 65,
                   {"of at least 30 deg (--from) was reached before failure, and none of the beds failed"}));
}

TEST_F(Perturb, draws_its_figure_where_there_is_matplotlib) {
  std::filesystem::create_directory(folder_.path("without"));
  write_file(folder_, "without/matplotlib.py",
             "raise ModuleNotFoundError(\"No module named 'matplotlib'\", name='matplotlib')\n");
  const Outcome without = talus(perturb("p", {"--seeds", "1"}), {"PYTHONPATH=" + folder_.path("without")});
  ASSERT_EQ(without.exit_code, 0) << without.err;
  EXPECT_TRUE(has_all(without.err, {"warning: the figure is left out", "python3-matplotlib"}));
  EXPECT_FALSE(folder_.has_file("p/perturb.pdf"));
  ASSERT_TRUE(ends(talus(perturb("p", {"--seeds", "1"})), 0));
  for (const char* drawn : {"p/perturb.csv", "p/perturb.pdf", "p/perturb.png", "p/perturb.json"})
    EXPECT_TRUE(folder_.has_file(drawn)) << drawn;
}

// The package is looked for next to the program.
TEST_F(Perturb, without_the_package_says_so) {
  std::filesystem::copy_file(talus_program(), folder_.path("talus"));
  const std::string command = "cd " + folder_.path().string() + " && ./talus perturb bed.toml -o p 2> said";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 69);
  EXPECT_TRUE(has(folder_.text("said"), "needs the Python package talus, which was not installed with"));
}

class InterruptedPerturb : public Perturb, public testing::WithParamInterface<int> {};

TEST_P(InterruptedPerturb, goes_on_to_the_same_table) {
  ASSERT_EQ(talus(perturb("whole", {"--seed", "1"})).exit_code, 0);
  const Words words = perturb("parts", {"--seed", "1"});
  const std::vector<int> codes =
      stop_until_done([&] { return folder_.start(words); }, GetParam(), 200, folder_.path("parts"));
  // The signal may arrive before the program handles it.
  for (const int code : codes)
    EXPECT_TRUE(code == 0 || code == -1 || (code == 75 && GetParam() != SIGKILL)) << code << folder_.errors();
  EXPECT_EQ(codes.back(), 0);
  EXPECT_EQ(folder_.hash("parts/seed-1.h5"), folder_.hash("whole/seed-1.h5"));
  EXPECT_EQ(io::RunFile::open(folder_.path("parts/seed-1.h5")).trials(),
            io::RunFile::open(folder_.path("whole/seed-1.h5")).trials());
}

INSTANTIATE_TEST_SUITE_P(Signals, InterruptedPerturb, testing::Values(SIGTERM, SIGKILL));

// Trials are committed together with the state at which they were made.
TEST_F(Perturb, pushes_no_copy_again_whose_trials_are_stored) {
  const std::string log = folder_.path("p/seed-1.log");
  const auto count_of_states = [&] { return count_of(text_of(log), " deg: "); };
  const pid_t process = folder_.start(perturb("p", {"--seed", "1"}));
  wait_until([&] { return count_of_states() != 0; });
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  kill(process, SIGKILL);
  wait_for(process);
  EXPECT_EQ(talus(perturb("p", {"--seed", "1"})).exit_code, 0);
  EXPECT_EQ(count_of_states(), 3u) << text_of(log);
}

TEST_F(Perturb, that_is_stopped_stops_its_seeds) {
  const CommandFolder folder("[bed]\nlength = 50\ndepth = 20\n");
  const pid_t process = folder.start(perturb("p", {"--seeds", "1-2"}));
  wait_until([&] { return folder.has_file("p/seed-1.h5.run/manifest"); });
  kill(process, SIGINT);
  EXPECT_EQ(wait_for(process), 75);
  EXPECT_FALSE(folder.has_file("p/perturb.md"));
}

TEST_F(Perturb, of_a_bad_form_leaves_with_64_before_anything_runs) {
  for (const Words& words :
       std::vector<Words>{{"perturb", "bed.toml"},
                          {"perturb", "bed.toml", "-o", "p", "--patch", "10"},
                          {"perturb", "bed.toml", "-o", "p", "--every", "0"},
                          {"perturb", "bed.toml", "-o", "p", "--seeds", "1", "--seed", "1"}})
    EXPECT_EQ(talus(words).exit_code, 64) << words.back();
  EXPECT_EQ(talus({"perturb", "bed.toml", "-o", "p", "--set", "tilt.stp=1"}).exit_code, 65);
  EXPECT_FALSE(folder_.has_file("p"));
}

TEST_F(Perturb, does_not_mix_plans_in_a_folder) {
  ASSERT_EQ(talus(perturb("p", {"--seed", "1"})).exit_code, 0);
  EXPECT_TRUE(ends(talus({"perturb", "bed.toml", "-o", "p", "--seeds", "1"}), 65,
                   {"have the task 'trials --from 8 --every 5 --patch 4x1'"}));
}

TEST_F(Perturb, takes_no_run_that_lacks_its_trials) {
  std::filesystem::create_directory(folder_.path("p"));
  take_run(folder_, "p/seed-1.h5", tiny_bed);
  EXPECT_TRUE(ends(talus(perturb("p", {"--seed", "1"})), 65,
                   {"has the trials 'none', expected '--from 8 --every 5 --patch 4x1'"}));
  EXPECT_EQ(talus(perturb("p", {"--seed", "2"})).exit_code, 0) << "another seed";
  std::filesystem::remove(folder_.path("p/seed-1.h5"));
  EXPECT_EQ(talus(perturb("p", {"--seed", "1"})).exit_code, 0);
}

TEST_F(Perturb, of_one_seed_computes_no_other_and_is_an_ensemble_that_others_may_compute) {
  EXPECT_TRUE(ends(talus(perturb("p", {"--seeds", "1-3", "--jobs", "0"})), 0, {"p: 0 of 3 done"}));
  const pid_t side_by_side = folder_.start(perturb("p", {"--seed", "2"}));
  EXPECT_EQ(talus(perturb("p", {"--seed", "2"})).exit_code, 0) << "it waits";
  EXPECT_TRUE(folder_.has_file("p/seed-2.h5"));
  EXPECT_EQ(wait_for(side_by_side), 0);
  for (const char* other : {"p/seed-1.h5", "p/seed-3.h5", "p/perturb.md"})
    EXPECT_FALSE(folder_.has_file(other)) << other;
  ASSERT_EQ(talus({"ensemble", "work", "p"}).exit_code, 0);
  EXPECT_TRUE(ends(talus(perturb("p", {"--seeds", "1-3", "--jobs", "0"})), 0, {"9 states of 3 runs"}));
}

}  // namespace
}  // namespace talus::test
