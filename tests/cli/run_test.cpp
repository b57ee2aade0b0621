/// Complete runs of a small bed: outputs, interruptions, resumption, bit-identical results.

#include <gtest/gtest.h>

#include "io/run_file.h"
#include "support/commands.h"

namespace talus::test {
namespace {

/// Bed that is deposited and fully tilted in about a second.
const char* const small_bed =
    "seed = 3\n[bed]\nlength = 16\ndepth = 6\n[tilt]\nend_angle = 3.0\n[output]\nframe_every = 0.5\n";

class Run : public CommandTest {
 protected:
  Run() : CommandTest(small_bed) {}
};

TEST_F(Run, leaves_one_file_that_tells_what_it_holds) {
  const Outcome run = talus({"run", "bed.toml", "-o", "bed.h5"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(folder_.has_file("bed.h5"));
  EXPECT_FALSE(folder_.has_file("bed.h5.run"));
  const std::string json = talus({"info", "bed.h5", "--json"}).out;
  EXPECT_EQ(json_value(json, "seed"), "3");
  EXPECT_EQ(json_value(json, "grains"), "96");
  EXPECT_EQ(json_value(json, "frames"), "7") << "0, 0.5, ... 3 deg";
  EXPECT_EQ(json_value(json, "complete"), "true");
  EXPECT_EQ(json_value(json, "theta_c_deg"), "null") << "this bed is stable at 3 deg";
  EXPECT_EQ(json_value(json, "state_hash").size(), 16u);
}

TEST_F(Run, of_a_bad_scenario_leaves_nothing) {
  write_file(folder_, "bad.toml", "seed = -1\n");
  const Outcome run = talus({"run", "bad.toml", "-o", "bed.h5"});
  EXPECT_TRUE(ends(run, 65, {"error: key 'seed'"}));
  EXPECT_EQ(run.out, "");
  EXPECT_FALSE(folder_.has_file("bed.h5") || folder_.has_file("bed.h5.run"));
}

TEST_F(Run, quiet_prints_nothing_but_warnings) {
  const Outcome run = talus({"run", "bed.toml", "--quiet"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(run.err.empty() || has(run.err, "warning")) << run.err;
}

TEST_F(Run, existing_output_is_refused_unless_told) {
  write_file(folder_, "bed.h5", "precious");
  EXPECT_TRUE(ends(talus({"run", "bed.toml", "-o", "bed.h5"}), 73, {"--overwrite"}));
  EXPECT_EQ(folder_.text("bed.h5"), "precious");
}

TEST_F(Run, has_the_name_of_a_run) {
  for (const char* name : {"new/bed.txt", "new/bed.h5.run", "new/bed.h5.part"})
    EXPECT_TRUE(ends(talus({"run", "bed.toml", "-o", name}), 64, {"which ends in .h5, such as new/bed.h5"}));
  EXPECT_EQ(talus({"run", "bed.toml", "-o", "new/bed.txt", "--pictures", "new"}).exit_code, 64);
  EXPECT_FALSE(folder_.has_file("new")) << "a refused run has left a folder";
  const Words at_rest = {"run", "bed.toml", "--set", "tilt.end_angle=0.001", "-o"};
  for (const char* name : {"bed", "friction-0.3", "bed.v2"})
    EXPECT_EQ(talus(at_rest + Words{name}).exit_code, 0);
}

TEST_F(Run, is_resumed_by_its_name_or_its_folder_alone) {
  for (const char* name : {"bed.h5", "./bed.h5.run/"}) {
    SCOPED_TRACE(name);
    ASSERT_TRUE(ends(talus({"run", "bed.toml", "--max-wall", "00:00:01", "--quiet", "--set", "seed=3",
                            "--set", "output.checkpoint_every=0", "--set", "tilt.end_angle=60"}),
                     75, {"for --max-wall; talus run --resume bed.h5 continues.\n"}));
    EXPECT_GT(io::RunFile::open(folder_.path("bed.h5")).checkpoint().world.step, 0);
    EXPECT_TRUE(ends(talus({"run", "bed.toml", "--resume", "--set", "contact.friction=0.3"}), 65));
    const Outcome again = talus({"run", "--resume", name, "--max-wall", "00:00:01"});
    EXPECT_EQ(again.exit_code, 75) << again.err;
    EXPECT_FALSE(has(again.err, "was started by version"));
    EXPECT_FALSE(folder_.has_file("bed.h5"));
    std::filesystem::remove_all(folder_.path("bed.h5.run"));
  }
}

TEST_F(Run, that_cannot_be_resumed_says_why) {
  const auto resume = [&](Words words) { return talus(Words{"run", "--resume"} + words); };
  EXPECT_TRUE(ends(resume({"bed.h5"}), 66, {"start it with: talus run SCENARIO -o bed.h5"}));
  write_file(folder_, "text.h5", "precious");
  EXPECT_EQ(resume({"text.h5"}).exit_code, 65);
  EXPECT_EQ(resume({"bed.h5", "--seed", "4"}).exit_code, 64);
  EXPECT_EQ(talus({"run", "bed.toml", "--max-wall", "90"}).exit_code, 64);
  EXPECT_FALSE(folder_.has_file("bed.h5.run"));
}

TEST_F(Run, that_is_complete_has_nothing_to_resume_but_a_folder_left_behind) {
  ASSERT_EQ(talus({"run", "bed.toml", "--set", "tilt.end_angle=0.5"}).exit_code, 0);
  std::filesystem::create_directory(folder_.path("bed.h5.run"));
  write_file(folder_, "bed.h5.run/segment_000001.h5", "left by a kill");
  const Outcome outcome = talus({"run", "--resume", "bed.h5"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "bed.h5 is already complete.\n");
  EXPECT_FALSE(folder_.has_file("bed.h5.run"));
}

TEST_F(Run, replaces_no_file_that_has_appeared_under_its_name) {
  const pid_t process = folder_.start({"run", "bed.toml", "-o", "bed.h5"});
  wait_until([&] { return has_ended(process) || folder_.has_file("bed.h5.run/manifest"); });
  write_file(folder_, "bed.h5", "precious");
  EXPECT_EQ(wait_for(process), 73);
  EXPECT_TRUE(has(folder_.errors(),
                  "bed.h5 was created by another process in the meantime, and is kept; the "
                  "run is in bed.h5.run: move the file away, and complete the run with talus "
                  "run --resume bed.h5"));
  EXPECT_EQ(folder_.text("bed.h5"), "precious");
  EXPECT_EQ(talus({"info", "bed.h5"}).exit_code, 0) << "the run in the folder";
  EXPECT_EQ(talus({"run", "--resume", "bed.h5"}).exit_code, 73);
  EXPECT_EQ(folder_.text("bed.h5"), "precious");
  std::filesystem::rename(folder_.path("bed.h5"), folder_.path("moved"));
  EXPECT_EQ(talus({"run", "--resume", "bed.h5"}).exit_code, 0);
  EXPECT_FALSE(folder_.has_file("bed.h5.run"));
  // The run of another name that appears is not removed either, and does not hide the folder once packing has
  // failed.
  const std::string other = folder_.text("bed.h5");
  const pid_t again = folder_.start({"run", "bed.toml", "-o", "new.h5", "--seed", "4"});
  wait_until([&] { return has_ended(again) || folder_.has_file("new.h5.run/manifest"); });
  std::filesystem::copy_file(folder_.path("bed.h5"), folder_.path("new.h5"));
  EXPECT_EQ(wait_for(again), 73);
  EXPECT_EQ(folder_.text("new.h5"), other);
  EXPECT_EQ(info("new.h5", "seed"), "4");
}

// In a loop over a parameter that gives every run the same name, the first run must not be accepted for all.
TEST_F(Run, of_another_scenario_is_not_taken_for_the_one_asked_for) {
  const auto run = [&](Words words) {
    return talus(Words{"run", "bed.toml", "-o", "bed.h5", "--resume", "--set", "tilt.end_angle=0.5"} + words);
  };
  ASSERT_EQ(run({}).exit_code, 0);
  EXPECT_EQ(run({}).exit_code, 0);
  EXPECT_TRUE(ends(run({"--set", "contact.friction=0.3", "--seed", "77"}), 65,
                   {"contact.friction is 0.5 there, 0.3 here", "77 here"}));
  EXPECT_EQ(talus({"run", "none.toml", "-o", "bed.h5", "--resume"}).exit_code, 66);
}

}  // namespace
}  // namespace talus::test
