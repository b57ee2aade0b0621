/// Each command with a wrong path: an incomplete run, its folder, a scenario instead of a run, a run instead
/// of a scenario, or the folder of an ensemble.

#include <gtest/gtest.h>

#include <filesystem>
#include <fmt/core.h>

#include "support/process.h"
#include "support/runs.h"

namespace talus::test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr const char* bed = "seed = 5\n[bed]\nlength = 10\ndepth = 2\n[tilt]\nend_angle = 0.2\n";

/// Commands with an argument that names a run or a scenario.
const Words takers_of_runs[] = {
    {"info", "X"},
    {"replay", "X"},
    {"repair", "X", "-o", "new.h5"},
    {"render", "X", "--map", "forces", "-o", "maps"},
    {"panel", "X", "--map", "forces", "--at", "frame0", "-o", "panel.png"},
    {"animate", "X", "--map", "forces", "-o", "movie.mp4"},
    {"analyze", "X"},
    {"events", "X"},
    {"figures", "X", "--only", "fig09", "-o", "figures"},
    {"export", "X", "--to", "csv", "-o", "tables"},
    {"dump", "X", "--at", "frame0", "-o", "problem.h5"},
    {"forces", "X", "--at", "frame0"},
};
const Words takers_of_scenarios[] = {
    {"run", "X"},
    {"ensemble", "X", "--seeds", "1", "-o", "beds"},
    {"study", "X", "--vary", "tilt.step=0.01", "--seeds", "1", "-o", "study"},
    {"perturb", "X", "--seeds", "1", "-o", "pushes"},
};

class MistakenPath : public testing::Test {
 protected:
  MistakenPath() { write_file(folder_, "bed.toml", bed); }

  Outcome call(Words words, const std::string& path) {
    words[1] = path;
    return run_talus(words, folder_.path());
  }

  void expect_refused(const Words& words, const std::string& path, const Words& parts) {
    const Outcome outcome = call(words, path);
    EXPECT_TRUE(outcome.exit_code == 65 || outcome.exit_code == 66) << words[0] << ": " << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("talus: error: ")) << words[0] << ": " << outcome.err;
    for (const std::string& part : parts)
      EXPECT_NE(outcome.err.find(part), std::string::npos) << words[0] << ": " << part << "\n" << outcome.err;
  }

  /// Creates a run that exists only as the folder stopped.h5.run.
  void create_stopped_run() {
    run_talus(
        {"run", "bed.toml", "-q", "-o", "stopped.h5", "--max-wall", "00:00:01", "--set", "tilt.end_angle=60"},
        folder_.path());
    ASSERT_TRUE(fs::is_directory(folder_.path("stopped.h5.run")));
    ASSERT_FALSE(fs::exists(folder_.path("stopped.h5")));
  }

  TemporaryFolder folder_;
};

TEST_F(MistakenPath, a_stopped_run_in_place_of_a_scenario_is_told_with_the_command_that_goes_on) {
  create_stopped_run();
  for (const char* path : {"stopped.h5", "stopped.h5.run", "stopped.h5.run/"})
    for (const Words& words : takers_of_scenarios)
      expect_refused(words, path,
                     {"is not a scenario but an incomplete run, now at ",
                      "resume it with: talus run --resume stopped.h5\n"});
  expect_refused({"run", "X", "--resume", "-o", "other.h5"}, "stopped.h5",
                 {"resume it with: talus run --resume stopped.h5\n"});
  const Outcome info = call({"info", "X"}, "stopped.h5");
  EXPECT_NE(info.out.find("to continue         talus run --resume stopped.h5\n"), std::string::npos)
      << info.out;
  EXPECT_EQ(call({"check", "X"}, "stopped.h5.run/").exit_code, 0);
}

TEST_F(MistakenPath, a_complete_run_in_place_of_a_scenario_is_told_with_what_takes_it) {
  take_run(folder_, "done.h5", bed);
  for (const Words& words : takers_of_scenarios)
    expect_refused(words, "done.h5",
                   {"done.h5 is not a scenario but a complete run; talus info done.h5 shows"});
}

TEST_F(MistakenPath, a_scenario_in_place_of_a_run_is_told_with_what_takes_it) {
  for (const Words& words : takers_of_runs)
    expect_refused(words, "bed.toml",
                   {"bed.toml: is not a Talus run file", "talus run bed.toml computes its run"});
}

TEST_F(MistakenPath, the_folder_of_an_ensemble_is_told_with_what_takes_it) {
  fs::create_directory(folder_.path("beds"));
  write_file(folder_, "beds/ensemble.manifest", "");
  take_run(folder_, "beds/seed-2.h5", bed);
  take_run(folder_, "beds/seed-1.h5", bed);
  for (const Words& words : takers_of_runs)
    if (words[0] != "figures" && words[0] != "analyze" && words[0] != "events")  // these commands accept it
      expect_refused(words, "beds",
                     {"beds is the folder of an ensemble; expected one of its runs, such as beds/seed-1.h5",
                      "talus figures beds ", "talus ensemble average beds averages them"});
  expect_refused({"check", "X"}, "beds", {"beds is the folder of an ensemble"});
  for (const Words& words : takers_of_scenarios)
    expect_refused(words, "beds",
                   {"not a scenario but the folder of an ensemble; talus ensemble work beds resumes"});
}

TEST_F(MistakenPath, a_folder_without_a_run_is_told) {
  fs::create_directory(folder_.path("empty"));
  fs::create_directory(folder_.path("begun.h5.run"));
  for (const Words& words : takers_of_runs) {
    expect_refused(words, "empty", {"empty is a folder, but not a run; expected a run file, or a folder"});
    expect_refused(words, "nothing.h5", {"nothing.h5: no such run; expected a run file, or a folder"});
    expect_refused(words, "begun.h5", {"begun.h5.run: nothing is committed there yet"});
  }
  for (const char* path : {"begun.h5.run", "begun.h5.run/"})
    expect_refused({"info", "X"}, path, {"begun.h5.run: nothing is committed there yet"});
  for (const Words& words : takers_of_scenarios)
    expect_refused(words, "empty", {"empty is a folder; expected a scenario file (TOML)"});
}

}  // namespace
}  // namespace talus::test
