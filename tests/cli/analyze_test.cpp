/// `talus analyze`: its output and the data it stores, for a tiny bed.

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include "support/process.h"
#include "support/runs.h"

namespace talus::test {
namespace {

/// Folder with a run of 32 grains that remains stable up to 1.5 deg: 4 frames.
class Analyze : public testing::Test {
 protected:
  Analyze() {
    take_run(folder_, "bed.h5",
             "[bed]\nlength = 10\ndepth = 4\n[tilt]\nend_angle = 1.5\n[output]\nframe_every = 0.5\n");
  }

  Outcome analyze(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"analyze", "bed.h5"});
    return run_talus(more, folder_.path());
  }
  std::string info() const { return run_talus({"info", "bed.h5", "--json"}, folder_.path()).out; }
  auto written() const { return std::filesystem::last_write_time(folder_.path("bed.h5")); }

  TemporaryFolder folder_;
};

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST_F(Analyze, prints_both_thresholds_side_by_side) {
  const Outcome outcome = analyze({"--set", "gamma_c=0.3"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_parts(outcome.out,
               {"bed.h5  (analysis stored in the file)",
                "4 frames, 0.00 to 1.50 deg; the slope has not failed; Gamma_c = 0.3000",
                "; l_c cut at 4 D\ngamma of each grain together with its neighbours within 1.5 D\n",
                "gamma >= 1 Gamma_c = 0.3000", "gamma >= 2 Gamma_c = 0.6000", "\n  1.50 ",
                "percolation, 2 Gamma_c", "dilation, centre of mass"});
}

TEST_F(Analyze, says_what_is_left_out_of_a_slope_that_stands) {
  const Outcome outcome = analyze();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_parts(
      outcome.out,
      {"the slope has not failed: overloaded grains need a threshold; set one with --set gamma_c=0.3"});
  EXPECT_EQ(outcome.out.find("p_o"), std::string::npos) << outcome.out;
}

TEST_F(Analyze, keeps_what_is_stored_and_valid) {
  const std::string before = info();
  ASSERT_EQ(analyze({"--set", "gamma_c=0.3"}).exit_code, 0);
  const auto first = written();
  const Outcome again = analyze({"--set", "gamma_c=0.3"});
  expect_parts(again.out, {"bed.h5  (analysis read from the file)", "gamma >= 2 Gamma_c = 0.6000"});
  EXPECT_EQ(written(), first);
  expect_parts(analyze({"--set", "gamma_c=0.2"}).out, {"(analysis stored in the file)"});
  expect_parts(analyze({"--set", "gamma_c=0.2", "--force"}).out, {"(analysis stored in the file)"});
  EXPECT_EQ(info(), before) << "the run is unchanged";
}

TEST_F(Analyze, gives_the_same_from_the_file_as_computed) {
  const std::string computed = analyze({"--json", "--set", "gamma_c=0.3", "--threads", "1"}).out;
  const std::string read = analyze({"--json", "--set", "gamma_c=0.3"}).out;
  EXPECT_EQ(json_value(read, "state"), "analysis read from the file");
  const std::string forced = analyze({"--json", "--set", "gamma_c=0.3", "--threads", "3", "--force"}).out;
  EXPECT_EQ(forced, computed) << "with another number of threads";
  const auto numbers = [](const std::string& text) { return text.substr(text.find("\"key\"")); };
  EXPECT_EQ(numbers(read), numbers(computed));
  EXPECT_EQ(json_value(computed, "gamma_c"), "0.3") << "the parameter precedes the data set";
  EXPECT_EQ(json_value(computed, "theta_c"), "null");
  EXPECT_EQ(computed.find("lc/length"), std::string::npos) << "values of single grains";
  expect_parts(computed, {"\"overloaded/fraction\": [[", "\"threshold\": [0.3, 0.6]", "\"tilt\": [0, "});
}

TEST_F(Analyze, json_is_a_list_of_runs) {
  const Outcome two = analyze({"bed.h5", "--json"});
  ASSERT_EQ(two.exit_code, 0) << two.err;
  write_file(folder_, "out.json", two.out);
  const std::string check =
      "/usr/bin/python3 -c \"import json,sys; a=json.load(open(sys.argv[1])); assert len(a)==2; "
      "assert len(a[0]['packing/stress'])==4 and len(a[0]['packing/stress'][3][1])==2\" " +
      folder_.path("out.json");
  EXPECT_EQ(std::system(check.c_str()), 0) << two.out;
}

TEST_F(Analyze, refuses_what_it_does_not_know) {
  const Outcome key = analyze({"--set", "lc_cut=-1", "--set", "colour=red"});
  EXPECT_EQ(key.exit_code, 65);
  expect_parts(key.err, {"--set lc_cut=-1: error: key 'lc_cut' = -1: expected a number in (0, 10000]",
                         "--set colour=red: error: unknown key 'colour'"});
  EXPECT_EQ(run_talus({"analyze"}, folder_.path()).exit_code, 64);
  EXPECT_EQ(run_talus({"analyze", "none.h5"}, folder_.path()).exit_code, 66);
  write_file(folder_, "text.h5", "not a run");
  EXPECT_EQ(run_talus({"analyze", "text.h5"}, folder_.path()).exit_code, 65);
}

TEST_F(Analyze, does_not_store_what_is_not_complete) {
  write_file(folder_, "long.toml",
             "[bed]\nlength = 10\ndepth = 4\n[tilt]\nrate = 0.1\nend_angle = 15\n"
             "[output]\nframe_every = 0.01\n");
  const pid_t process = start_talus({"run", "long.toml"}, folder_.path());
  Outcome outcome;
  for (int wait = 0; wait < 1000 && outcome.exit_code != 0; ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    outcome = run_talus({"analyze", "long.h5"}, folder_.path());
  }
  kill(process, SIGTERM);
  EXPECT_EQ(wait_for(process), 75);
  expect_parts(outcome.out, {"long.h5  (analysis not stored: the run is not complete)"});
}

}  // namespace
}  // namespace talus::test
