/// Commands in a scenario, branches of a run, and tilt programmes, as users create and inspect them.

#include <gtest/gtest.h>

#include <set>

#include "support/commands.h"
#include "support/runs.h"

namespace talus::test {
namespace {

const char* const plain_bed =
    "[bed]\nlength = 10\ndepth = 3\n[deposition]\nmethod = \"collapse\"\nrest_velocity = 0.1\n"
    "[tilt]\nrate = 20\nstep = 0.02\nend_angle = 4\n[output]\nframe_every = 0.5\nobservable_every = 0.2\n";
const char* const scripted =
    "[[command]]\nat = 1.06\nkind = \"drop\"\ngrain = 4\nx = 0.05\ny = 0.02\n"
    "[[command]]\ntime = 0.1\nkind = \"friction\"\nx = 0.3\n"
    "[[command]]\nat = 30\nkind = \"push\"\ngrain = 7\ny = 0.5\n";

class ScriptedCommandLine : public CommandTest {
 protected:
  ScriptedCommandLine() : CommandTest(std::string(plain_bed) + scripted) {}
};

TEST_F(ScriptedCommandLine, a_run_tells_what_was_carried_out_and_what_was_not) {
  const Outcome run = talus({"run", "bed.toml", "-o", "bed.h5"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(has(run.err,
                  "talus: warning: command.3 (push grain 7 by (0, 0.5) m/s, at 30 deg) was not carried "
                  "out: the run ended earlier, at 4.000 deg\n"));
  EXPECT_TRUE(has_all(talus({"info", "bed.h5"}).out,
                      {"1.060 deg    drop 4 grains at x = 0.05 m from 0.02 m above the surface\n",
                       "2.000 deg    friction 0.3\n",
                       "not carried out     command.3: push grain 7 by (0, 0.5) m/s, at 30 deg\n"}));
  EXPECT_EQ(info("bed.h5", "commands"), "2");
  EXPECT_EQ(talus({"replay", "bed.h5", "--threads", "2"}).exit_code, 0);
  EXPECT_EQ(talus({"check", "bed.h5"}).exit_code, 0);

  // `talus check` writes the same scenario.
  write_file(folder_, "full.toml", talus({"check", "bed.toml"}).out);
  ASSERT_EQ(talus({"run", "full.toml", "-q", "-o", "full.h5"}).exit_code, 0);
  EXPECT_EQ(folder_.hash("full.h5"), folder_.hash("bed.h5"));
}

TEST_F(ScriptedCommandLine, a_branch_begins_with_a_frame) {
  write_file(folder_, "plain.toml", plain_bed);
  take_run(folder_, "plain.h5", plain_bed);
  const auto branch = [&](Words more) {
    return talus(Words{"run", "--branch", "plain.h5", "-o", "branch.h5", "--overwrite"} + more);
  };
  ASSERT_EQ(branch({"--at", "1", "bed.toml"}).exit_code, 0);
  EXPECT_EQ(info("branch.h5", "branch_frame"), "2");
  EXPECT_EQ(info("branch.h5", "commands"), "2");
  const std::string hash = folder_.hash("branch.h5");
  EXPECT_EQ(talus({"replay", "branch.h5"}).exit_code, 0);
  EXPECT_EQ(talus({"check", "branch.h5"}).exit_code, 0);
  ASSERT_EQ(branch({"--at", "frame2", "bed.toml", "--threads", "2", "-q"}).exit_code, 0);
  EXPECT_EQ(folder_.hash("branch.h5"), hash);
  ASSERT_EQ(
      branch({"--at", "1", "--set", "contact.friction=0.2", "--set", "tilt.after_failure=lower"}).exit_code,
      0);
  EXPECT_NE(folder_.hash("branch.h5"), hash);
  EXPECT_EQ(info("branch.h5", "branch_of"), "plain.h5");
}

TEST_F(ScriptedCommandLine, a_branch_may_have_more_or_less_rolling_friction_than_the_run) {
  take_run(folder_, "free.h5", plain_bed);
  const auto expect_branch = [&](const char* run, const char* rolling_friction, const char* name) {
    const Outcome branch =
        talus({"run", "--branch", run, "--at", "frame1", "--set",
               std::string("contact.rolling_friction=") + rolling_friction, "-q", "-o", name});
    ASSERT_EQ(branch.exit_code, 0) << branch.err;
    const Outcome check = talus({"check", name});
    EXPECT_EQ(check.exit_code, 0) << name << ": " << check.out << check.err;
    EXPECT_EQ(talus({"replay", name}).exit_code, 0) << name;
  };
  expect_branch("free.h5", "0.1", "some.h5");
  expect_branch("some.h5", "0.2", "more.h5");
  expect_branch("some.h5", "0.01", "less.h5");
  expect_branch("some.h5", "0", "none.h5");
}

// In the run the friction is 0.5 up to 2 deg, and 0.3 from there on.
TEST_F(ScriptedCommandLine, a_branch_takes_the_friction_that_is_given_or_that_of_the_run) {
  ASSERT_EQ(talus({"run", "bed.toml", "-q", "-o", "bed.h5"}).exit_code, 0);
  const auto branch = [&](const std::string& name, Words more) {
    return talus(Words{"run", "--branch", "bed.h5", "--at", "3", "-q", "-o", name} + more);
  };
  ASSERT_EQ(branch("same.h5", {}).exit_code, 0);
  EXPECT_EQ(info("same.h5", "friction"), "0.3");
  EXPECT_TRUE(has(talus({"info", "same.h5"}).out, "friction            0.3\n"));
  ASSERT_EQ(branch("given.h5", {"--set", "contact.friction=0.5"}).exit_code, 0);
  EXPECT_EQ(info("given.h5", "friction"), "0.5");
  EXPECT_NE(folder_.hash("given.h5"), folder_.hash("same.h5"));
  for (const char* run : {"same.h5", "given.h5"}) {
    EXPECT_EQ(talus({"check", run}).exit_code, 0) << run;
    EXPECT_EQ(talus({"replay", run}).exit_code, 0) << run;
  }
  // A file that still has the friction of the beginning, and no command, does not say which of both is meant.
  write_file(folder_, "plain.toml", plain_bed);
  ASSERT_EQ(branch("file.h5", {"bed.toml"}).exit_code, 0);
  EXPECT_EQ(info("file.h5", "friction"), "0.3");
  ASSERT_EQ(branch("file.h5", {"bed.toml", "--overwrite", "--set", "contact.friction=0.9"}).exit_code, 0);
  EXPECT_EQ(info("file.h5", "friction"), "0.9");
}

TEST_F(ScriptedCommandLine, a_branch_that_cannot_be_is_refused) {
  take_run(folder_, "plain.h5", plain_bed);
  const auto refused = [&](Words more, int code, const std::string& message) {
    more.insert(more.begin(), {"run", "--branch", "plain.h5"});
    EXPECT_TRUE(ends(talus(more), code, {message}));
    EXPECT_FALSE(folder_.has_file("b.h5"));
  };
  refused({"--at", "1"}, 64, "name the branch of plain.h5 with -o");
  refused({"-o", "b.h5"}, 64, "--at");
  refused({"-o", "b.h5", "--at", "repose"}, 65, "the slope has not failed");
  refused({"-o", "b.h5", "--at", "frame99"}, 65, "frame");
  refused({"-o", "b.h5", "--at", "4"}, 64, "plain.h5: the run ends with its frame at 4.000 deg");
  refused({"-o", "b.h5", "--at", "1", "--seed", "2"}, 64, "omit --seed");
  refused({"-o", "b.h5", "--at", "1", "--set", "bed.length=12"}, 65, "bed.length is 10 there, 12 here");
  refused({"-o", "b.h5", "--at", "1", "--resume"}, 64, "--resume");
  refused({"-o", "plain.h5", "--at", "1", "--overwrite"}, 64, "plain.h5 is read by this command");
  refused({"bed.toml", "-o", "b.h5", "--at", "2"}, 65,
          "command.1 is due at 1.06 deg, before the branch of plain.h5 begins");
}

/// Small bed that is tilted up and down twice and then fails within a few seconds.
const char* const cycled_bed =
    "seed = 2\n[bed]\nlength = 20\ndepth = 6\n[deposition]\nrate = 2\nrest_velocity = 0.05\n"
    "[tilt]\nrate = 20\nstep = 0.02\nprogram = [\"to 4\", \"hold 0.1\", \"to -2\", \"2 times\", \"to "
    "repose\"]\n"
    "[output]\nframe_every = 1\nobservable_every = 0.2\n";

class TiltProgramCommands : public CommandTest {
 protected:
  TiltProgramCommands() : CommandTest(cycled_bed) {}

  std::set<std::string> files_in(const std::string& name) const { return names_in(folder_.path(name)); }
};

TEST_F(TiltProgramCommands, check_tells_the_programme_and_what_it_takes) {
  const Outcome check = talus({"check", "bed.toml"});
  ASSERT_TRUE(ends(check, 0,
                   {"program = [\"to 4\", \"hold 0.1\", \"to -2\", \"2 times\", \"to repose\"]",
                    "#   programme   7 parts, repetitions included, 2.4 s if it fails at 20 deg\n",
                    "about 2400 of tilt (failure at 20 deg)"}));
  write_file(folder_, "full.toml", check.out);
  EXPECT_TRUE(has(talus({"check", "full.toml", "--json"}).out, "\"tilt_steps\": 2400"));
  EXPECT_TRUE(
      has(talus({"check", "bed.toml", "--set", "tilt.program=to 4, to 0, 3 times"}).out, " 1200 of tilt\n"));
}

TEST_F(TiltProgramCommands, a_run_is_made_told_replayed_drawn_and_exported) {
  ASSERT_EQ(talus({"run", "bed.toml", "-q", "-o", "bed.h5", "--pictures", "live", "--map", "gamma", "--set",
                   "gamma_c=0.342", "--size", "300"})
                .exit_code,
            0);
  const std::string info = talus({"info", "bed.h5", "--json"}).out;
  const int frames = std::stoi(json_value(info, "frames"));
  EXPECT_NEAR(std::stod(json_value(info, "tilt_lowest_deg")), -2.0, 1e-9);
  EXPECT_TRUE(has(talus({"info", "bed.h5"}).out, "by a programme"));
  EXPECT_EQ(talus({"replay", "bed.h5"}).exit_code, 0);
  EXPECT_EQ(talus({"check", "bed.h5"}).exit_code, 0);

  // One picture per frame, although several frames have the same angle.
  EXPECT_EQ(static_cast<int>(files_in("live").size()), frames);
  EXPECT_TRUE(files_in("live").contains("gamma_00000_000.00.png"));
  ASSERT_TRUE(ends(talus({"render", "bed.h5", "--map", "gamma", "--every", "0.001", "--set", "gamma_c=0.342",
                          "--size", "300", "-o", "maps"}),
                   0));
  EXPECT_EQ(files_in("maps"), files_in("live"));
  ASSERT_TRUE(ends(talus({"render", "bed.h5", "--map", "gamma", "--at", "4,frame9,repose", "--trace",
                          "stress_ratio,overloaded", "--size", "300", "-o", "some"}),
                   0));
  EXPECT_EQ(files_in("some").size(), 3u);
  EXPECT_TRUE(files_in("some").contains("gamma_00004_004.00.png")) << "the first frame at 4 deg";
  ASSERT_TRUE(ends(
      talus({"render", "bed.h5", "--map", "gamma", "--at=-2", "--turned", "--size", "300", "-o", "turned"}),
      0));
  EXPECT_EQ(files_in("turned").size(), 1u);

  EXPECT_EQ(talus({"export", "bed.h5", "--to", "observables", "-o", "rows.csv"}).exit_code, 0);
  EXPECT_EQ(talus({"export", "bed.h5", "--to", "paraview", "--at", "0,4", "-o", "paraview"}).exit_code, 0);
  EXPECT_EQ(talus({"dump", "bed.h5", "--at", "4", "-o", "problem.h5"}).exit_code, 0);
}

TEST_F(TiltProgramCommands, the_analysis_says_what_its_angles_refer_to) {
  take_run(folder_, "bed.h5", cycled_bed);
  EXPECT_TRUE(ends(talus({"analyze", "bed.h5"}), 0,
                   {"theta_c, theta_d and the first slide refer to the last rise, from 0", " -2.00 to "}));
  EXPECT_TRUE(has(talus({"analyze", "bed.h5"}).out, "(analysis read from the file)"));
}

TEST_F(TiltProgramCommands, cycles_are_a_figure_of_runs_that_have_them) {
  take_run(folder_, "bed.h5", cycled_bed);
  ASSERT_TRUE(ends(talus({"figures", "bed.h5", "--only", "cycles", "-o", "figures"}), 0));
  for (const char* file : {"cycles.png", "cycles.pdf", "cycles.csv", "cycles-ends.csv"})
    EXPECT_TRUE(files_in("figures").contains(file)) << file;
  take_run(folder_, "plain.h5", cycled_bed, {"--set", "tilt.program=none", "--set", "tilt.end_angle=2"});
  EXPECT_NE(talus({"figures", "plain.h5", "--only", "cycles", "-o", "none"}).exit_code, 0);
}

}  // namespace
}  // namespace talus::test
