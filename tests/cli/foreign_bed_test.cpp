/// Beds written by other programs or by an export.

#include <gtest/gtest.h>

#include "support/commands.h"
#include "support/runs.h"

namespace talus::test {
namespace {

const char* const collapsed_bed =
    "[bed]\nlength = 10\ndepth = 3\n[deposition]\nmethod = \"collapse\"\nrest_velocity = 0.1\n"
    "[tilt]\nrate = 20\nstep = 0.02\nend_angle = 1\n[output]\nframe_every = 0.5\nobservable_every = 0.2\n";

class ForeignBed : public CommandTest {
 protected:
  ForeignBed() : CommandTest(collapsed_bed) {}
  static Words from_file(const std::string& file) {
    return {"--set", "deposition.method=file", "--set", "deposition.file=" + file};
  }
  Outcome run_from(const std::string& file, const Words& more) {
    return talus(Words{"run", "bed.toml", "--overwrite", "-o", "from.h5"} + from_file(file) + more);
  }
  std::string grains_of(const std::string& run) { return info(run, "grains"); }
};

TEST_F(ForeignBed, is_read_from_what_talus_exports) {
  take_run(folder_, "run.h5", collapsed_bed);
  const std::pair<const char*, const char*> files[] = {
      {"lammps", "grains.dump"}, {"xyz", "grains.xyz"}, {"csv", "tables"}};
  for (const auto& [format, file] : files) {
    ASSERT_EQ(talus({"export", "run.h5", "--to", format, "-o", file}).exit_code, 0) << format;
    const std::string path = std::string(file) + (file == std::string("tables") ? "/grains.csv" : "");
    const Outcome run = run_from(path, {"--set", "deposition.frame=-1"});
    ASSERT_TRUE(ends(run, 0, {"10 grains with their tops at y = 0 left out as the floor\n"}));
    EXPECT_TRUE(run.out.starts_with(path + ": frame 2 of 3")) << run.out;
    EXPECT_EQ(grains_of("from.h5"), "30");
    EXPECT_EQ(talus({"replay", "from.h5"}).exit_code, 0);
  }
}

TEST_F(ForeignBed, of_soft_grains_is_told_how_far_they_were_moved) {
  write_file(
      folder_, "soft.txt",
      "#format x_y_z_r\n0.02\t0.1\t0.006\t0.005\n0.0295\t0.1\t0.006\t0.005\n0.06\t0.1\t0.016\t0.005\n");
  const Words metres = {"--set", "deposition.file_unit=m"};
  for (const char* command : {"check", "run"})
    EXPECT_TRUE(
        ends(talus(Words{command, "bed.toml"} + from_file("soft.txt") + metres), 65,
             {"soft.txt:3:1: error: the grain overlaps with the grain in line 2 by 0.05 D: expected at "
              "most 0.01 D; deposition.relax = true"}));
  EXPECT_FALSE(folder_.has_file("bed.h5.run")) << "it is refused before its first step";
  const Outcome run = run_from("soft.txt", metres + Words{"--set", "deposition.relax=true"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(run.out.starts_with(
      "soft.txt: x and z are the plane, because y is the same for all; overlaps pushed apart, which "
      "moved grains by 0.017 D on average, 0.025 D at most\n"))
      << run.out;
  EXPECT_TRUE(has(talus(Words{"check", "bed.toml"} + from_file("soft.txt") +
                        Words{"--set", "deposition.file_scale=100", "--set", "deposition.relax=true"})
                      .out,
                  "# soft.txt: x and z are the plane"));
}

}  // namespace
}  // namespace talus::test
