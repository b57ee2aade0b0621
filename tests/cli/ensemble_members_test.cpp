/// Irregular members of an ensemble: invalid values, foreign tables, changed beds, and symbolic links.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "support/commands.h"

namespace talus::test {
namespace {

Words ensemble_of(const std::string& folder, const std::string& seeds) {
  return {"ensemble", "bed.toml", "--seeds", seeds, "-o", folder};
}

/// Two grains side by side on a smooth floor and one on top of them, in both orders.
const char* const three_grains = "x,y,radius\n10.55,0.5,0.5\n9.45,0.5,0.5\n10,1.3351646544245033,0.5\n";
const char* const other_grains = "x,y,radius\n0.55,0.5,0.5\n19.45,0.5,0.5\n0,1.3351646544245033,0.5\n";
const char* const bed_of_file =
    "[bed]\nlength = 20\ndepth = 1\nfloor = \"smooth\"\n[tilt]\nend_angle = 0.01\n[deposition]\nmethod = "
    "\"file\"\n";

using EnsembleMembers = StableBedTest;

TEST_F(EnsembleMembers, is_not_stopped_by_a_value_with_a_mistake_in_it) {
  const CommandFolder folder(bed_of_file);
  write_file(folder, "a.csv", three_grains);
  write_file(folder, "b.csv", other_grains);
  const auto ensemble = [&](const std::string& files, const std::string& jobs = "1") {
    return folder.talus({"ensemble", "bed.toml", "--seeds", "1-2", "--vary", "deposition.file=" + files,
                         "--jobs", jobs, "-o", "e"});
  };
  EXPECT_EQ(ensemble("a.csv,typo.csv").exit_code, 66);
  EXPECT_FALSE(folder.has_file("e")) << "rejected before anything is created";
  EXPECT_EQ(ensemble("a.csv").exit_code, 0);
  EXPECT_EQ(ensemble("a.csv,typo.csv").exit_code, 66);
  EXPECT_EQ(ensemble("a.csv,b.csv", "0").exit_code, 0);
  // A member whose bed disappears later fails, and the others continue.
  std::filesystem::rename(folder.path("b.csv"), folder.path("c.csv"));
  EXPECT_EQ(ensemble("a.csv,c.csv", "0").exit_code, 0) << "b.csv is unavailable and is withdrawn";
  EXPECT_EQ(ensemble("c.csv").out.find("e: 4 of 4 done"), 0u);
  std::filesystem::rename(folder.path("c.csv"), folder.path("b.csv"));
  const Outcome more =
      folder.talus({"ensemble", "bed.toml", "--seeds", "3", "--vary", "deposition.file=a.csv", "-o", "e"});
  EXPECT_EQ(more.exit_code, 66) << more.err;
  EXPECT_TRUE(more.out.starts_with("e: 5 of 6 done, 0 under way, 1 failed")) << more.out;
}

TEST_F(EnsembleMembers, are_no_branches_although_these_have_the_scenario_and_the_seed) {
  ASSERT_EQ(talus(ensemble_of("e", "1-2")).exit_code, 0);
  std::filesystem::rename(folder_.path("e/seed-2.h5"), folder_.path("whole.h5"));
  ASSERT_EQ(talus({"run", "--branch", "whole.h5", "--at", "0.5", "-q", "-o", "e/seed-2.h5"}).exit_code, 0);
  for (const Words& words : {ensemble_of("e", "1-2"),
                             {"ensemble", "average", "e"},
                             {"figures", "e", "--only", "fig09", "-o", "f"}})
    EXPECT_TRUE(ends(talus(words), 65,
                     {"e/seed-2.h5 is not a run of its scenario alone, as the members of an ensemble "
                      "are: branch at 0.50 deg"}));
}

TEST_F(EnsembleMembers, whose_files_are_damaged_stop_no_others_and_are_begun_anew) {
  ASSERT_EQ(talus(ensemble_of("e", "1-3")).exit_code, 0);
  const std::string whole = folder_.text("e/seed-2.h5"), averages = folder_.text("e/averages.csv");
  const auto state_of_second = [&] { return folder_.hash("e/seed-2.h5"); };
  const std::string state = state_of_second();
  std::string flipped = whole;
  flipped[flipped.size() / 2] ^= 1;
  int number = 0;
  for (const std::string& damaged :
       {whole.substr(0, whole.size() / 2), flipped, std::string(), std::string("talus")}) {
    SCOPED_TRACE(damaged.size());
    write_file(folder_, "e/seed-2.h5", damaged);
    EXPECT_TRUE(ends(talus({"ensemble", "status", "e"}), 0, {"2 of 3 done", "damaged: seed-2: e/seed-2.h5"}));
    EXPECT_TRUE(ends(talus({"ensemble", "average", "e"}), 65));
    EXPECT_EQ(std::ranges::count(folder_.text("e/members.csv"), '\n'), 3)
        << "rows of the other members are written";
    if (number % 2 == 0) {
      EXPECT_TRUE(ends(talus({"ensemble", "retry", "e"}), 0,
                       {"1 member is waiting again; talus ensemble work e computes it"}));
    }
    EXPECT_TRUE(ends(talus(ensemble_of("e", "1-3")), 0));
    EXPECT_EQ(state_of_second(), state);
    EXPECT_EQ(folder_.text("e/averages.csv"), averages);
    const std::string aside =
        ++number == 1 ? "e/seed-2.h5.damaged" : "e/seed-2.h5.damaged-" + std::to_string(number);
    EXPECT_TRUE(folder_.text(aside) == damaged) << "no data are lost";
  }
}

TEST_F(EnsembleMembers, of_another_scenario_stop_no_others) {
  ASSERT_EQ(talus(ensemble_of("e", "1-2")).exit_code, 0);
  ASSERT_EQ(talus({"run", "bed.toml", "--set", "contact.friction=0.3", "-o", "e/seed-1.h5", "--overwrite"})
                .exit_code,
            0);
  EXPECT_TRUE(ends(talus(ensemble_of("e", "1-3")), 65, {"e/seed-1.h5 is a run of another scenario"}));
  EXPECT_TRUE(folder_.has_file("e/seed-3.h5")) << "it was computed anyway";
  EXPECT_FALSE(folder_.has_file("e/seed-1.h5.damaged")) << "it is complete";
}

TEST_F(EnsembleMembers, of_a_value_with_a_mistake_are_withdrawn_though_they_had_begun) {
  const auto ensemble = [&](const std::string& times) {
    return talus(
        {"ensemble", "bed.toml", "--seeds", "1-2", "--vary", "deposition.max_time=" + times, "-o", "e"});
  };
  EXPECT_EQ(ensemble("60,0.001").exit_code, 65);
  const Outcome corrected = ensemble("60,50");
  EXPECT_TRUE(ends(corrected, 0, {"e: 4 of 4 done"}));
  EXPECT_TRUE(has(corrected.err, "deposition.max_time=0.001 is withdrawn"));
  EXPECT_TRUE(folder_.has_file("e/deposition.max_time=0.001/seed-2.h5.withdrawn"));
}

TEST_F(EnsembleMembers, knows_whose_a_run_is) {
  ASSERT_EQ(talus(ensemble_of("e", "1-2") + Words{"--vary", "contact.friction=0.3,0.5"}).exit_code, 0);
  const std::string here = folder_.path("e/contact.friction=0.3/seed-"),
                    there = folder_.path("e/contact.friction=0.5/seed-");
  const auto refused_with = [&](const std::string& from, const std::string& to) {
    const std::string whole = text_of(to);
    std::ofstream(to) << text_of(from);
    const Outcome average = talus({"ensemble", "average", "e"});
    std::ofstream(to) << whole;
    return average.exit_code == 65 && has(average.err, std::filesystem::path(to).filename().string());
  };
  EXPECT_TRUE(refused_with(there + "1.h5", here + "1.h5")) << "another scenario";
  EXPECT_TRUE(refused_with(here + "1.h5", here + "2.h5")) << "another seed";
  EXPECT_EQ(talus({"ensemble", "average", "e"}).exit_code, 0) << "everything is unchanged";
}

TEST_F(EnsembleMembers, knows_the_bed_that_its_members_begin_with) {
  const CommandFolder folder(bed_of_file);
  write_file(folder, "a.csv", three_grains);
  const auto ensemble = [&](const std::string& frictions, const std::string& seeds, const std::string& jobs) {
    return folder.talus({"ensemble", "bed.toml", "--set", "deposition.file=a.csv", "--vary",
                         "contact.friction=" + frictions, "--seeds", seeds, "--jobs", jobs, "-o", "e"});
  };
  ASSERT_EQ(ensemble("0.3", "1", "1").exit_code, 0);
  ASSERT_EQ(ensemble("0.3", "1-2", "0").exit_code, 0);
  write_file(folder, "a.csv", other_grains);
  EXPECT_TRUE(ends(ensemble("0.3,0.5", "1", "1"), 65, {"/a.csv (deposition.file) no longer holds the bed"}));
  EXPECT_EQ(folder.talus({"ensemble", "work", "e"}).exit_code, 0);
  EXPECT_TRUE(has(folder.text("e/contact.friction=0.3/seed-2.failed"),
                  "/a.csv (deposition.file) no longer holds the bed"));
  EXPECT_TRUE(ends(folder.talus({"replay", "e/contact.friction=0.3/seed-1.h5"}), 65,
                   {"/a.csv (deposition.file) no longer holds the bed"}));
  write_file(folder, "a.csv", three_grains);
  EXPECT_EQ(folder.talus({"replay", "e/contact.friction=0.3/seed-1.h5"}).exit_code, 0);
  EXPECT_EQ(folder.talus({"ensemble", "retry", "e"}).exit_code, 0);
  EXPECT_EQ(ensemble("0.3,0.5", "1", "1").out.find("e: 4 of 4 done"), 0u);
}

// Another process may own the run and end; a member whose file is locked is therefore tried a second time.
TEST_F(EnsembleMembers, that_are_refused_their_file_are_tried_again_before_they_count_as_failed) {
  std::filesystem::create_directories(folder_.path("e/seed-1.h5"));
  const Outcome outcome = talus(ensemble_of("e", "1-2"));
  EXPECT_EQ(outcome.exit_code, 73) << outcome.out << outcome.err;
  EXPECT_TRUE(has(outcome.out, "failed: seed-1, exit code 73"));
  EXPECT_TRUE(folder_.has_file("e/seed-2.h5"));
  EXPECT_EQ(count_of(folder_.text("e/seed-1.log"), "talus: error: "), 2u) << folder_.text("e/seed-1.log");
  std::filesystem::remove(folder_.path("e/seed-1.h5"));
  EXPECT_EQ(talus({"ensemble", "retry", "e"}).exit_code, 0);
  EXPECT_EQ(talus(ensemble_of("e", "1-2")).exit_code, 0);
}

}  // namespace
}  // namespace talus::test
