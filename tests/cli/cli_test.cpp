/// Options, messages and exit codes.

#include <gtest/gtest.h>

#include "support/process.h"

namespace talus::test {
namespace {

TEST(CommandLine, help_names_every_subcommand) {
  const TemporaryFolder folder;
  const Outcome outcome = run_talus({"--help"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* command : {"run", "check", "info", "render", "animate", "panel", "study", "export"})
    EXPECT_NE(outcome.out.find(std::string("\n  ") + command), std::string::npos) << command;
}

TEST(CommandLine, help_of_each_subcommand_ends_well) {
  const TemporaryFolder folder;
  for (const char* command : {"run", "check", "info", "render", "animate", "panel", "study", "export"})
    EXPECT_EQ(run_talus({command, "--help"}, folder.path()).exit_code, 0) << command;
}

TEST(CommandLine, version_is_told) {
  const TemporaryFolder folder;
  const Outcome outcome = run_talus({"--version"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out.rfind("talus ", 0), 0u);
  for (const char* part : {"\ncompiler      ", "\nwindow        ", "\nrun files     schema version 4\n",
                           "\nanalyses      version "})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << outcome.out;
}

TEST(CommandLine, wrong_usage_leaves_with_64) {
  const TemporaryFolder folder;
  EXPECT_EQ(run_talus({}, folder.path()).exit_code, 64);
  EXPECT_EQ(run_talus({"dance"}, folder.path()).exit_code, 64);
  EXPECT_EQ(run_talus({"run", "x.toml", "--no-such-option"}, folder.path()).exit_code, 64);
  EXPECT_EQ(run_talus({"run", "x.toml", "--threads", "0"}, folder.path()).exit_code, 64);
  EXPECT_EQ(run_talus({"run", "x.toml", "--resume", "--overwrite"}, folder.path()).exit_code, 64);
}

TEST(CommandLine, missing_input_leaves_with_66_and_names_it) {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"run", "none.toml"},
                                                    {"check", "none.toml"},
                                                    {"info", "none.h5"},
                                                    {"render", "none.h5", "--map", "gamma"}}) {
    const Outcome outcome = run_talus(arguments, folder.path());
    EXPECT_EQ(outcome.exit_code, 66) << arguments[0];
    EXPECT_NE(outcome.err.find("none."), std::string::npos) << outcome.err;
  }
}

TEST(CommandLine, bad_scenario_leaves_with_65_and_tells_where) {
  const TemporaryFolder folder;
  const std::string name = write_file(folder, "bad.toml", "[contact]\nfricton = 0.5\nwall_friction = -1\n");
  const Outcome outcome = run_talus({"run", name, "-o", "bad.h5"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 65);
  EXPECT_NE(outcome.err.find("bad.toml:2:1: error:"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("did you mean"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("bad.toml:3:"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "bad.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "bad.h5.run"));
}

TEST(CommandLine, a_file_that_is_no_run_leaves_with_65) {
  const TemporaryFolder folder;
  write_file(folder, "text.h5", "this is no run file");
  const Outcome outcome = run_talus({"info", "text.h5"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 65) << outcome.err;
  EXPECT_NE(outcome.err.find("text.h5"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace talus::test
