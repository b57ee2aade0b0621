/// `talus analyze` and `talus events`: their output and the data they store, for a tiny bed.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "support/commands.h"
#include "support/runs.h"

namespace talus::test {
namespace {

class Events : public CommandTest {
 protected:
  Events() { take_run(folder_, "bed.h5", stable_bed, {"--seed", "2"}); }

  Outcome events(Words more = {}) const { return folder_.talus(Words{"events", "bed.h5"} + more); }
};

/// Threshold low enough that the entire tilt is one event.
const Words all_moves = {"--set", "event_velocity=1e-9"};

TEST_F(Events, of_a_bed_that_stands_still_are_none) {
  ASSERT_TRUE(
      ends(events(), 0,
           {"bed.h5  (analysis stored in the file)\n0 events up to 1.50 deg; the slope has not failed\n",
            "An event: rms velocity of at least 2.82e-04 sqrt(g D), ",
            "until the bed has been quiet for 1 sqrt(D/g)", "number, and energy released       0, 0 m g D\n",
            "sizes                             no law: 0 events, 10 needed\n",
            "share that dilates the bed        none\n"}));
  EXPECT_TRUE(has(events().out, "analysis read from the file"));
  EXPECT_TRUE(has(folder_.talus({"analyze", "bed.h5"}).out, "no law: 0 events, 10 needed"));
}

TEST_F(Events, that_are_not_over_are_marked_and_not_counted) {
  ASSERT_TRUE(ends(events(all_moves), 0,
                   {"\n1 event up to 1.50 deg", "   deg      deg  sqrt(D/g)", "  not over\n",
                    "0 grains: none moved by event_displacement between the frames around the event\n",
                    "number, and energy released       0, 0 m g D\n"}));
}

TEST_F(Events, are_told_as_json_and_as_csv) {
  EXPECT_TRUE(ends(events(Words{"--json"} + all_moves), 0,
                   {"[{\n  \"path\": \"bed.h5\"", "\"count\": 0", "\"size_exponent\": null",
                    "\"events\": [{\n    \"begin\": 0,", "\"kind\": 2", "\"centre\": [", "}]\n}]\n"}));
  const Outcome csv = events(Words{"bed.h5", "--csv"} + all_moves);
  ASSERT_EQ(csv.exit_code, 0) << csv.err;
  EXPECT_TRUE(csv.out.starts_with("run,begin (rad),end (rad),time (s),")) << csv.out;
  EXPECT_EQ(std::ranges::count(csv.out, '\n'), 3) << "one line of names, and one event of each run\n"
                                                  << csv.out;
  EXPECT_TRUE(has(csv.out, "\n\"bed.h5\",0,"));
  EXPECT_EQ(std::ranges::count(csv.out.substr(0, csv.out.find('\n')), ',') * 3,
            std::ranges::count(csv.out, ','));
}

TEST_F(Events, name_the_first_grains_that_moved_so_far) {
  ASSERT_TRUE(ends(events({"--displacement", "1e-5"}), 0,
                   {"of 40 grains moved 1e-05 D or more since the tilt began\n", "grain  frame  theta",
                    "the first 20; --csv and --json list all\n"}));
  const Outcome csv = folder_.talus({"events", "bed.h5", "bed.h5", "--displacement", "1e-5", "--csv"});
  EXPECT_TRUE(csv.out.starts_with(
      "run,grain,frame,tilt (rad),time (s),x (m),y (m),depth (m),displacement (m)\n\"bed.h5\","))
      << csv.out;
  EXPECT_GT(std::ranges::count(csv.out, '\n'), 41) << "all events of both runs";
  EXPECT_TRUE(ends(events({"--displacement", "5", "--json"}), 0,
                   {"[{\n  \"path\": \"bed.h5\"", "\"displacement\": 0.05", "\"grains\": []"}));
  EXPECT_TRUE(
      ends(events({"--displacement", "5"}), 0, {"0 of 40 grains moved 5 D or more since the tilt began\n"}));
  EXPECT_EQ(events({"--displacement", "5", "--largest", "3"}).exit_code, 64);
  EXPECT_EQ(events({"--displacement", "0"}).exit_code, 64);
}

TEST_F(Events, of_an_ensemble_are_those_of_its_members) {
  write_file(folder_, "bed.toml",
             "[bed]\nlength = 10\ndepth = 4\n[tilt]\nend_angle = 0.5\n[output]\nframe_every = 0.5\n");
  ASSERT_EQ(folder_.talus({"ensemble", "bed.toml", "--seeds", "1,2", "-o", "beds"}).exit_code, 0);
  for (const char* command : {"events", "analyze"})
    EXPECT_TRUE(ends(talus({command, "beds", "bed.h5"}), 0, {"beds/seed-1.h5", "beds/seed-2.h5", "bed.h5"}));
}

TEST_F(Events, are_refused_with_what_is_wrong) {
  EXPECT_TRUE(ends(events({"--set", "event_velocty=1"}), 65, {"did you mean 'event_velocity'?"}));
  EXPECT_EQ(events({"--json", "--csv"}).exit_code, 64);
  EXPECT_EQ(events({"--json", "--largest", "3"}).exit_code, 64);
  EXPECT_EQ(events({"--largest", "0"}).exit_code, 64);
}

class Analyze : public CommandTest {
 protected:
  Analyze() { take_run(folder_, "bed.h5", stable_bed); }

  Outcome analyze(Words more = {}) const { return folder_.talus(Words{"analyze", "bed.h5"} + more); }
  std::string info() const { return folder_.talus({"info", "bed.h5", "--json"}).out; }
  auto written() const { return std::filesystem::last_write_time(folder_.path("bed.h5")); }
};

TEST_F(Analyze, prints_both_thresholds_side_by_side) {
  ASSERT_TRUE(ends(analyze({"--set", "gamma_c=0.1"}), 0,
                   {"bed.h5  (analysis stored in the file)",
                    "4 frames, 0.00 to 1.50 deg; the slope has not failed; Gamma_c = 0.1000",
                    "; l_c cut at 4 D\ngamma of each grain together with its neighbours within 1.5 D\n",
                    "gamma >= 1 Gamma_c = 0.1000", "gamma >= 2 Gamma_c = 0.2000", "\n  1.50 ",
                    "percolation, 2 Gamma_c", "dilation, centre of mass"}));
}

TEST_F(Analyze, says_what_is_left_out_of_a_slope_that_stands) {
  const Outcome outcome = analyze();
  EXPECT_TRUE(
      ends(outcome, 0,
           {"the slope has not failed: overloaded grains need a threshold; set one with --set gamma_c=0.3"}));
  EXPECT_FALSE(has(outcome.out, "p_o"));
}

TEST_F(Analyze, keeps_what_is_stored_and_valid) {
  const std::string before = info();
  ASSERT_EQ(analyze({"--set", "gamma_c=0.3"}).exit_code, 0);
  const auto first = written();
  EXPECT_TRUE(ends(analyze({"--set", "gamma_c=0.3"}), 0,
                   {"bed.h5  (analysis read from the file)", "no grain reaches 2 Gamma_c = 0.6000"}));
  EXPECT_EQ(written(), first);
  EXPECT_TRUE(has(analyze({"--set", "gamma_c=0.2"}).out, "(analysis stored in the file)"));
  EXPECT_TRUE(has(analyze({"--set", "gamma_c=0.2", "--force"}).out, "(analysis stored in the file)"));
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
  EXPECT_FALSE(has(computed, "lc/length")) << "values of single grains";
  EXPECT_TRUE(
      has_all(computed, {"\"overloaded/fraction\": [[", "\"threshold\": [0.3, 0.6]", "\"tilt\": [0, "}));
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
  EXPECT_TRUE(ends(analyze({"--set", "lc_cut=-1", "--set", "colour=red"}), 65,
                   {"--set lc_cut=-1: error: key 'lc_cut' = -1: expected a number in (0, 10000]",
                    "--set colour=red: error: unknown key 'colour'"}));
  EXPECT_EQ(folder_.talus({"analyze"}).exit_code, 64);
}

TEST_F(Analyze, does_not_store_what_is_not_complete) {
  write_file(folder_, "long.toml",
             "[bed]\nlength = 10\ndepth = 4\n[tilt]\nrate = 0.1\nend_angle = 15\n"
             "[output]\nframe_every = 0.01\n");
  const pid_t process = folder_.start({"run", "long.toml"});
  Outcome outcome;
  wait_until([&] { return (outcome = folder_.talus({"analyze", "long.h5"})).exit_code == 0; });
  kill(process, SIGTERM);
  EXPECT_EQ(wait_for(process), 75);
  EXPECT_TRUE(has(outcome.out, "long.h5  (analysis not stored: the run is not complete)"));
}

}  // namespace
}  // namespace talus::test
