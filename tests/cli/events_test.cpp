/// `talus events`: its output for a tiny bed.

#include <gtest/gtest.h>

#include <algorithm>

#include "support/process.h"
#include "support/runs.h"

namespace talus::test {
namespace {

/// Bed of 32 grains that remains stable up to 1.5 deg.
class Events : public testing::Test {
 protected:
  Events() {
    take_run(
        folder_, "bed.h5",
        "seed = 2\n[bed]\nlength = 10\ndepth = 4\n[tilt]\nend_angle = 1.5\n[output]\nframe_every = 0.5\n");
  }

  Outcome events(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"events", "bed.h5"});
    return run_talus(more, folder_.path());
  }

  TemporaryFolder folder_;
};

void expect_texts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

/// Threshold low enough that the entire tilt is one event.
const std::vector<std::string> all_moves = {"--set", "event_velocity=1e-9"};

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST_F(Events, of_a_bed_that_stands_still_are_none) {
  const Outcome outcome = events();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_texts(
      outcome.out,
      {"bed.h5  (analysis stored in the file)\n0 events up to 1.50 deg; the slope has not failed\n",
       "An event: rms velocity of at least 2.82e-04 sqrt(g D), ",
       "until the bed has been quiet for 1 sqrt(D/g)", "number, and energy released       0, 0 m g D\n",
       "sizes                             no law: 0 events, 10 needed\n",
       "share that dilates the bed        none\n"});
  expect_texts(events().out, {"analysis read from the file"});
  expect_texts(run_talus({"analyze", "bed.h5"}, folder_.path()).out, {"no law: 0 events, 10 needed"});
}

TEST_F(Events, that_are_not_over_are_marked_and_not_counted) {
  const Outcome outcome = events(all_moves);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_texts(outcome.out, {"\n1 event up to 1.50 deg", "   deg      deg  sqrt(D/g)", "  not over\n",
                             "number, and energy released       0, 0 m g D\n"});
}

TEST_F(Events, are_told_as_json_and_as_csv) {
  const Outcome json = events(with({"--json"}, all_moves));
  ASSERT_EQ(json.exit_code, 0) << json.err;
  expect_texts(json.out, {"[{\n  \"path\": \"bed.h5\"", "\"count\": 0", "\"size_exponent\": null",
                          "\"events\": [{\n    \"begin\": 0,", "\"kind\": 2", "\"centre\": [", "}]\n}]\n"});
  const Outcome csv = run_talus(with({"events", "bed.h5", "bed.h5", "--csv"}, all_moves), folder_.path());
  ASSERT_EQ(csv.exit_code, 0) << csv.err;
  EXPECT_TRUE(csv.out.starts_with("run,begin (rad),end (rad),time (s),")) << csv.out;
  EXPECT_EQ(std::ranges::count(csv.out, '\n'), 3) << "one line of names, and one event of each run\n"
                                                  << csv.out;
  const auto lines = csv.out.find("\n\"bed.h5\",0,");
  ASSERT_NE(lines, std::string::npos) << csv.out;
  EXPECT_EQ(std::ranges::count(csv.out.substr(0, csv.out.find('\n')), ',') * 3,
            std::ranges::count(csv.out, ','));
}

TEST_F(Events, name_the_first_grains_that_moved_so_far) {
  const Outcome table = events({"--displacement", "1e-5"});
  ASSERT_EQ(table.exit_code, 0) << table.err;
  expect_texts(table.out, {"of 40 grains moved 1e-05 D or more since the tilt began\n", "grain  frame  theta",
                           "the first 20; --csv and --json list all\n"});
  const Outcome csv =
      run_talus({"events", "bed.h5", "bed.h5", "--displacement", "1e-5", "--csv"}, folder_.path());
  EXPECT_TRUE(csv.out.starts_with(
      "run,grain,frame,tilt (rad),time (s),x (m),y (m),depth (m),displacement (m)\n\"bed.h5\","))
      << csv.out;
  EXPECT_GT(std::ranges::count(csv.out, '\n'), 41) << "all events of both runs";
  const Outcome json = events({"--displacement", "5", "--json"});
  expect_texts(json.out, {"[{\n  \"path\": \"bed.h5\"", "\"displacement\": 0.05", "\"grains\": []"});
  expect_texts(events({"--displacement", "5"}).out,
               {"0 of 40 grains moved 5 D or more since the tilt began\n"});
  EXPECT_EQ(events({"--displacement", "5", "--largest", "3"}).exit_code, 64);
  EXPECT_EQ(events({"--displacement", "0"}).exit_code, 64);
}

TEST_F(Events, of_an_ensemble_are_those_of_its_members) {
  write_file(folder_, "bed.toml",
             "[bed]\nlength = 10\ndepth = 4\n[tilt]\nend_angle = 0.5\n[output]\nframe_every = 0.5\n");
  ASSERT_EQ(run_talus({"ensemble", "bed.toml", "--seeds", "1,2", "-o", "beds"}, folder_.path()).exit_code, 0);
  for (const char* command : {"events", "analyze"}) {
    const Outcome outcome = run_talus({command, "beds", "bed.h5"}, folder_.path());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_texts(outcome.out, {"beds/seed-1.h5", "beds/seed-2.h5", "bed.h5"});
  }
}

TEST_F(Events, are_refused_with_what_is_wrong) {
  EXPECT_EQ(run_talus({"events", "none.h5"}, folder_.path()).exit_code, 66);
  const Outcome typo = events({"--set", "event_velocty=1"});
  EXPECT_EQ(typo.exit_code, 65);
  expect_texts(typo.err, {"did you mean 'event_velocity'?"});
  EXPECT_EQ(events({"--json", "--csv"}).exit_code, 64);
  EXPECT_EQ(events({"--json", "--largest", "3"}).exit_code, 64);
  EXPECT_EQ(events({"--largest", "0"}).exit_code, 64);
}

}  // namespace
}  // namespace talus::test
