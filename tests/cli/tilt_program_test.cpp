/// Runs with a tilt programme, as users create and inspect them.

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "support/process.h"
#include "support/runs.h"

namespace talus::test {
namespace {

/// Small bed that is tilted up and down twice and then fails within a few seconds.
const char* const cycled_bed =
    "seed = 2\n[bed]\nlength = 20\ndepth = 6\n[deposition]\nrate = 2\nrest_velocity = 0.05\n"
    "[tilt]\nrate = 20\nstep = 0.02\nprogram = [\"to 4\", \"hold 0.1\", \"to -2\", \"2 times\", \"to "
    "repose\"]\n"
    "[output]\nframe_every = 1\nobservable_every = 0.2\n";

class TiltProgramCommands : public testing::Test {
 protected:
  TiltProgramCommands() { write_file(folder_, "bed.toml", cycled_bed); }

  Outcome talus(const std::vector<std::string>& arguments) { return run_talus(arguments, folder_.path()); }
  std::set<std::string> files_in(const std::string& name) const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path(name)))
      names.insert(entry.path().filename().string());
    return names;
  }

  TemporaryFolder folder_;
};

TEST_F(TiltProgramCommands, check_tells_the_programme_and_what_it_takes) {
  const Outcome check = talus({"check", "bed.toml"});
  ASSERT_EQ(check.exit_code, 0) << check.err;
  EXPECT_NE(check.out.find("program = [\"to 4\", \"hold 0.1\", \"to -2\", \"2 times\", \"to repose\"]"),
            std::string::npos);
  EXPECT_NE(check.out.find("#   programme   7 parts, repetitions included, 2.4 s if it fails at 20 deg\n"),
            std::string::npos)
      << check.out;
  EXPECT_NE(check.out.find("about 2400 of tilt (failure at 20 deg)"), std::string::npos) << check.out;
  write_file(folder_, "full.toml", check.out);
  EXPECT_EQ(talus({"check", "full.toml", "--json"}).out.find("\"tilt_steps\": 2400") == std::string::npos,
            false);
  const Outcome ends = talus({"check", "bed.toml", "--set", "tilt.program=to 4, to 0, 3 times"});
  EXPECT_NE(ends.out.find(" 1200 of tilt\n"), std::string::npos) << ends.out;
}

TEST_F(TiltProgramCommands, a_bad_one_is_refused_before_anything_is_made) {
  const Outcome run = talus({"run", "bed.toml", "-o", "bed.h5", "--set", "tilt.program=to 4, hold"});
  EXPECT_EQ(run.exit_code, 65);
  EXPECT_NE(run.err.find("key 'tilt.program' = \"hold\": expected "), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.path("bed.h5")));
  const Outcome vary = talus({"check", "bed.toml", "--set", "tilt.end_angle=5"});
  EXPECT_EQ(vary.exit_code, 65);
  EXPECT_NE(vary.err.find("no tilt.end_angle, because"), std::string::npos) << vary.err;
}

TEST_F(TiltProgramCommands, a_run_is_made_told_replayed_drawn_and_exported) {
  ASSERT_EQ(talus({"run", "bed.toml", "-q", "-o", "bed.h5", "--pictures", "live", "--map", "gamma",
                   "--theta-c", "20", "--width", "300"})
                .exit_code,
            0);
  const std::string info = talus({"info", "bed.h5", "--json"}).out;
  const int frames = std::stoi(json_value(info, "frames"));
  EXPECT_NEAR(std::stod(json_value(info, "tilt_lowest_deg")), -2.0, 1e-9);
  EXPECT_NE(talus({"info", "bed.h5"}).out.find("by a programme"), std::string::npos);
  EXPECT_EQ(talus({"replay", "bed.h5"}).exit_code, 0);
  EXPECT_EQ(talus({"check", "bed.h5"}).exit_code, 0);

  // One picture per frame, although several frames have the same angle.
  EXPECT_EQ(static_cast<int>(files_in("live").size()), frames);
  EXPECT_TRUE(files_in("live").contains("gamma_00000_000.00.png"));
  const Outcome all = talus({"render", "bed.h5", "--map", "gamma", "--every", "0.001", "--theta-c", "20",
                             "--width", "300", "-o", "maps"});
  ASSERT_EQ(all.exit_code, 0) << all.err;
  EXPECT_EQ(files_in("maps"), files_in("live"));
  const Outcome some = talus({"render", "bed.h5", "--map", "gamma", "--at", "4,frame9,repose", "--trace",
                              "stress_ratio,overloaded", "--width", "300", "-o", "some"});
  ASSERT_EQ(some.exit_code, 0) << some.err;
  EXPECT_EQ(files_in("some").size(), 3u);
  EXPECT_TRUE(files_in("some").contains("gamma_00004_004.00.png")) << "the first frame at 4 deg";
  const Outcome turned =
      talus({"render", "bed.h5", "--map", "gamma", "--at=-2", "--turned", "--width", "300", "-o", "turned"});
  ASSERT_EQ(turned.exit_code, 0) << turned.err;
  EXPECT_EQ(files_in("turned").size(), 1u);

  EXPECT_EQ(talus({"export", "bed.h5", "--to", "observables", "-o", "rows.csv"}).exit_code, 0);
  EXPECT_EQ(talus({"export", "bed.h5", "--to", "paraview", "--at", "0,4", "-o", "paraview"}).exit_code, 0);
  EXPECT_EQ(talus({"dump", "bed.h5", "--at", "4", "-o", "problem.h5"}).exit_code, 0);
}

TEST_F(TiltProgramCommands, the_analysis_says_what_its_angles_refer_to) {
  take_run(folder_, "bed.h5", cycled_bed);
  const Outcome analysis = talus({"analyze", "bed.h5"});
  ASSERT_EQ(analysis.exit_code, 0) << analysis.err;
  EXPECT_NE(analysis.out.find("theta_c, theta_d and the first slide refer to the last rise, from 0"),
            std::string::npos)
      << analysis.out;
  EXPECT_NE(talus({"analyze", "bed.h5"}).out.find("(analysis read from the file)"), std::string::npos);
  EXPECT_NE(analysis.out.find(" -2.00 to "), std::string::npos) << analysis.out;
}

TEST_F(TiltProgramCommands, cycles_are_a_figure_of_runs_that_have_them) {
  take_run(folder_, "bed.h5", cycled_bed);
  const Outcome figure = talus({"figures", "bed.h5", "--only", "cycles", "-o", "figures"});
  ASSERT_EQ(figure.exit_code, 0) << figure.err;
  for (const char* file : {"cycles.png", "cycles.pdf", "cycles.csv", "cycles-ends.csv"})
    EXPECT_TRUE(files_in("figures").contains(file)) << file;
  take_run(folder_, "plain.h5", cycled_bed, {"--set", "tilt.program=none", "--set", "tilt.end_angle=2"});
  EXPECT_NE(talus({"figures", "plain.h5", "--only", "cycles", "-o", "none"}).exit_code, 0);
}

}  // namespace
}  // namespace talus::test
