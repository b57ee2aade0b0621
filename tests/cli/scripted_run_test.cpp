/// Commands in a scenario and branches of a run, as users create and inspect them.

#include <gtest/gtest.h>

#include <filesystem>

#include "support/process.h"
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

class ScriptedCommandLine : public testing::Test {
 protected:
  ScriptedCommandLine() { write_file(folder_, "bed.toml", std::string(plain_bed) + scripted); }
  Outcome talus(const std::vector<std::string>& arguments) { return run_talus(arguments, folder_.path()); }
  std::string info(const std::string& run, const std::string& key) {
    return json_value(talus({"info", run, "--json"}).out, key);
  }
  TemporaryFolder folder_;
};

TEST_F(ScriptedCommandLine, a_run_tells_what_was_carried_out_and_what_was_not) {
  const Outcome run = talus({"run", "bed.toml", "-o", "bed.h5"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(
      run.err.find("talus: warning: command.3 (push grain 7 by (0, 0.5) m/s, at 30 deg) was not carried "
                   "out: the run ended earlier, at 4.000 deg\n"),
      std::string::npos)
      << run.err;
  const std::string text = talus({"info", "bed.h5"}).out;
  for (const char* line : {"1.060 deg    drop 4 grains at x = 0.05 m from 0.02 m above the surface\n",
                           "2.000 deg    friction 0.3\n",
                           "not carried out     command.3: push grain 7 by (0, 0.5) m/s, at 30 deg\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line << text;
  EXPECT_EQ(info("bed.h5", "commands"), "2");
  EXPECT_EQ(talus({"replay", "bed.h5", "--threads", "2"}).exit_code, 0);
  EXPECT_EQ(talus({"check", "bed.h5"}).exit_code, 0);

  // `talus check` writes the same scenario.
  write_file(folder_, "full.toml", talus({"check", "bed.toml"}).out);
  ASSERT_EQ(talus({"run", "full.toml", "-q", "-o", "full.h5"}).exit_code, 0);
  EXPECT_EQ(info("full.h5", "state_hash"), info("bed.h5", "state_hash"));
}

TEST_F(ScriptedCommandLine, an_ensemble_varies_a_command) {
  const Outcome ensemble = talus({"ensemble", "bed.toml", "--seeds", "1", "--vary", "command.1.grain=2,4",
                                  "-o", "drops", "--jobs", "1"});
  ASSERT_EQ(ensemble.exit_code, 0) << ensemble.err;
  ASSERT_EQ(talus({"run", "bed.toml", "-q", "-o", "bed.h5"}).exit_code, 0);
  const auto hash = [&](const char* grains) {
    return info(std::string("drops/command.1.grain=") + grains + "/seed-1.h5", "state_hash");
  };
  EXPECT_EQ(hash("4"), info("bed.h5", "state_hash"));
  EXPECT_NE(hash("2"), hash("4"));
}

TEST_F(ScriptedCommandLine, a_branch_begins_with_a_frame) {
  write_file(folder_, "plain.toml", plain_bed);
  take_run(folder_, "plain.h5", plain_bed);
  const auto branch = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"run", "--branch", "plain.h5", "-o", "branch.h5", "--overwrite"});
    return talus(more);
  };
  ASSERT_EQ(branch({"--at", "1", "bed.toml"}).exit_code, 0);
  EXPECT_EQ(info("branch.h5", "branch_frame"), "2");
  EXPECT_EQ(info("branch.h5", "commands"), "2");
  const std::string hash = info("branch.h5", "state_hash");
  EXPECT_EQ(talus({"replay", "branch.h5"}).exit_code, 0);
  EXPECT_EQ(talus({"check", "branch.h5"}).exit_code, 0);
  ASSERT_EQ(branch({"--at", "frame2", "bed.toml", "--threads", "2", "-q"}).exit_code, 0);
  EXPECT_EQ(info("branch.h5", "state_hash"), hash);
  ASSERT_EQ(
      branch({"--at", "1", "--set", "contact.friction=0.2", "--set", "tilt.after_failure=lower"}).exit_code,
      0);
  EXPECT_NE(info("branch.h5", "state_hash"), hash);
  EXPECT_EQ(info("branch.h5", "branch_of"), "plain.h5");
}

// In the run the friction is 0.5 up to 2 deg, and 0.3 from there on.
TEST_F(ScriptedCommandLine, a_branch_takes_the_friction_that_is_given_or_that_of_the_run) {
  ASSERT_EQ(talus({"run", "bed.toml", "-q", "-o", "bed.h5"}).exit_code, 0);
  const auto branch = [&](const std::string& name, std::vector<std::string> more) {
    more.insert(more.begin(), {"run", "--branch", "bed.h5", "--at", "3", "-q", "-o", name});
    return talus(more);
  };
  ASSERT_EQ(branch("same.h5", {}).exit_code, 0);
  EXPECT_EQ(info("same.h5", "friction"), "0.3");
  EXPECT_NE(talus({"info", "same.h5"}).out.find("friction            0.3\n"), std::string::npos);
  ASSERT_EQ(branch("given.h5", {"--set", "contact.friction=0.5"}).exit_code, 0);
  EXPECT_EQ(info("given.h5", "friction"), "0.5");
  EXPECT_NE(info("given.h5", "state_hash"), info("same.h5", "state_hash"));
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
  const auto refused = [&](std::vector<std::string> more, int code, const std::string& message) {
    more.insert(more.begin(), {"run", "--branch", "plain.h5"});
    const Outcome outcome = talus(more);
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path("b.h5")));
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

}  // namespace
}  // namespace talus::test
