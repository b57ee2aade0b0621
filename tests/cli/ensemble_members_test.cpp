/// Irregular members of an ensemble: invalid values, foreign tables, changed beds, and symbolic links.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>

#include "base/hash.h"
#include "support/places.h"
#include "support/process.h"

namespace talus::test {
namespace {

/// Bed of 32 grains that is deposited and fully tilted in a fraction of a second.
const char* const tiny_bed =
    "[bed]\nlength = 10\ndepth = 4\n[tilt]\nend_angle = 1.5\n[output]\nframe_every = 0.5\n";

std::vector<std::string> ensemble_of(const std::string& folder, const std::string& seeds) {
  return {"ensemble", "bed.toml", "--seeds", seeds, "-o", folder};
}

/// Two grains side by side on a smooth floor and one on top of them, in both orders.
const char* const three_grains = "x,y,radius\n10.55,0.5,0.5\n9.45,0.5,0.5\n10,1.3351646544245033,0.5\n";
const char* const other_grains = "x,y,radius\n0.55,0.5,0.5\n19.45,0.5,0.5\n0,1.3351646544245033,0.5\n";
const char* const bed_of_file =
    "[bed]\nlength = 20\ndepth = 1\nfloor = \"smooth\"\n[tilt]\nend_angle = 0.01\n[deposition]\nmethod = "
    "\"file\"\n";

TEST(EnsembleMembers, is_not_stopped_by_a_value_with_a_mistake_in_it) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", bed_of_file);
  write_file(folder, "a.csv", three_grains);
  write_file(folder, "b.csv", other_grains);
  const auto ensemble = [&](const std::string& files, const std::string& jobs = "1") {
    return run_talus({"ensemble", "bed.toml", "--seeds", "1-2", "--vary", "deposition.file=" + files,
                      "--jobs", jobs, "-o", "e"},
                     folder.path());
  };
  EXPECT_EQ(ensemble("a.csv,typo.csv").exit_code, 66);
  EXPECT_FALSE(std::filesystem::exists(folder.path("e"))) << "rejected before anything is created";
  EXPECT_EQ(ensemble("a.csv").exit_code, 0);
  EXPECT_EQ(ensemble("a.csv,typo.csv").exit_code, 66);
  EXPECT_EQ(ensemble("a.csv,b.csv", "0").exit_code, 0);
  // A member whose bed disappears later fails, and the others continue.
  std::filesystem::rename(folder.path("b.csv"), folder.path("c.csv"));
  EXPECT_EQ(ensemble("a.csv,c.csv", "0").exit_code, 0) << "b.csv is unavailable and is withdrawn";
  EXPECT_EQ(ensemble("c.csv").out.find("e: 4 of 4 done"), 0u);
  std::filesystem::rename(folder.path("c.csv"), folder.path("b.csv"));
  const Outcome more = run_talus(
      {"ensemble", "bed.toml", "--seeds", "3", "--vary", "deposition.file=a.csv", "-o", "e"}, folder.path());
  EXPECT_EQ(more.exit_code, 66) << more.err;
  EXPECT_EQ(more.out.find("e: 5 of 6 done, 0 under way, 1 failed"), 0u) << more.out;
}

TEST(EnsembleMembers, are_no_branches_although_these_have_the_scenario_and_the_seed) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(ensemble_of("e", "1-2"), folder.path()).exit_code, 0);
  std::filesystem::rename(folder.path("e/seed-2.h5"), folder.path("whole.h5"));
  ASSERT_EQ(
      run_talus({"run", "--branch", "whole.h5", "--at", "0.5", "-q", "-o", "e/seed-2.h5"}, folder.path())
          .exit_code,
      0);
  for (const std::vector<std::string>& words : {ensemble_of("e", "1-2"),
                                                {"ensemble", "average", "e"},
                                                {"figures", "e", "--only", "fig09", "-o", "f"}}) {
    const Outcome outcome = run_talus(words, folder.path());
    EXPECT_EQ(outcome.exit_code, 65) << outcome.err;
    EXPECT_NE(
        outcome.err.find("e/seed-2.h5 is not a run of its scenario alone, as the members of an ensemble "
                         "are: branch at 0.50 deg"),
        std::string::npos)
        << outcome.err;
  }
}

TEST(EnsembleMembers, whose_files_are_damaged_stop_no_others_and_are_begun_anew) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(ensemble_of("e", "1-3"), folder.path()).exit_code, 0);
  const std::string whole = text_of(folder.path("e/seed-2.h5")),
                    averages = text_of(folder.path("e/averages.csv"));
  const auto state_of_second = [&] {
    return json_value(run_talus({"info", "e/seed-2.h5", "--json"}, folder.path()).out, "state_hash");
  };
  const std::string state = state_of_second();
  std::string flipped = whole;
  flipped[flipped.size() / 2] ^= 1;
  int number = 0;
  for (const std::string& damaged :
       {whole.substr(0, whole.size() / 2), flipped, std::string(), std::string("talus")}) {
    SCOPED_TRACE(damaged.size());
    write_file(folder, "e/seed-2.h5", damaged);
    const Outcome status = run_talus({"ensemble", "status", "e"}, folder.path());
    EXPECT_EQ(status.exit_code, 0) << status.err;
    EXPECT_NE(status.out.find("2 of 3 done"), std::string::npos) << status.out;
    EXPECT_NE(status.out.find("damaged: seed-2: e/seed-2.h5"), std::string::npos) << status.out;
    const Outcome average = run_talus({"ensemble", "average", "e"}, folder.path());
    EXPECT_EQ(average.exit_code, 65);
    EXPECT_EQ(std::ranges::count(text_of(folder.path("e/members.csv")), '\n'), 3)
        << "rows of the other members are written";
    if (number % 2 == 0) {
      const Outcome retry = run_talus({"ensemble", "retry", "e"}, folder.path());
      EXPECT_EQ(retry.exit_code, 0) << retry.err;
      EXPECT_NE(retry.out.find("1 members are waiting again"), std::string::npos) << retry.out;
    }
    const Outcome again = run_talus(ensemble_of("e", "1-3"), folder.path());
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(state_of_second(), state);
    EXPECT_EQ(text_of(folder.path("e/averages.csv")), averages);
    const std::string aside =
        ++number == 1 ? "e/seed-2.h5.damaged" : "e/seed-2.h5.damaged-" + std::to_string(number);
    EXPECT_TRUE(text_of(folder.path(aside)) == damaged) << "no data are lost";
  }
}

TEST(EnsembleMembers, of_another_scenario_stop_no_others) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(ensemble_of("e", "1-2"), folder.path()).exit_code, 0);
  ASSERT_EQ(
      run_talus({"run", "bed.toml", "--set", "contact.friction=0.3", "-o", "e/seed-1.h5", "--overwrite"},
                folder.path())
          .exit_code,
      0);
  const Outcome more = run_talus(ensemble_of("e", "1-3"), folder.path());
  EXPECT_EQ(more.exit_code, 65);
  EXPECT_NE(more.err.find("e/seed-1.h5 is a run of another scenario"), std::string::npos) << more.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path("e/seed-3.h5"))) << "it was computed anyway";
  EXPECT_FALSE(std::filesystem::exists(folder.path("e/seed-1.h5.damaged"))) << "it is complete";
}

TEST(EnsembleMembers, of_a_value_with_a_mistake_are_withdrawn_though_they_had_begun) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  const auto ensemble = [&](const std::string& times) {
    return run_talus(
        {"ensemble", "bed.toml", "--seeds", "1-2", "--vary", "deposition.max_time=" + times, "-o", "e"},
        folder.path());
  };
  EXPECT_EQ(ensemble("60,0.001").exit_code, 65);
  const Outcome corrected = ensemble("60,50");
  EXPECT_EQ(corrected.exit_code, 0) << corrected.err;
  EXPECT_NE(corrected.out.find("e: 4 of 4 done"), std::string::npos) << corrected.out;
  EXPECT_NE(corrected.err.find("deposition.max_time=0.001 is withdrawn"), std::string::npos) << corrected.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path("e/deposition.max_time=0.001/seed-2.h5.withdrawn")));
}

TEST(EnsembleMembers, knows_whose_a_run_is) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  std::vector<std::string> words = ensemble_of("e", "1-2");
  words.insert(words.end(), {"--vary", "contact.friction=0.3,0.5"});
  ASSERT_EQ(run_talus(words, folder.path()).exit_code, 0);
  const std::string here = folder.path("e/contact.friction=0.3/seed-"),
                    there = folder.path("e/contact.friction=0.5/seed-");
  const auto refused_with = [&](const std::string& from, const std::string& to) {
    const std::string whole = text_of(to);
    std::ofstream(to) << text_of(from);
    const Outcome average = run_talus({"ensemble", "average", "e"}, folder.path());
    std::ofstream(to) << whole;
    return average.exit_code == 65 &&
           average.err.find(std::filesystem::path(to).filename().string()) != std::string::npos;
  };
  EXPECT_TRUE(refused_with(there + "1.h5", here + "1.h5")) << "another scenario";
  EXPECT_TRUE(refused_with(here + "1.h5", here + "2.h5")) << "another seed";
  EXPECT_EQ(run_talus({"ensemble", "average", "e"}, folder.path()).exit_code, 0) << "everything is unchanged";
}

TEST(EnsembleMembers, knows_the_bed_that_its_members_begin_with) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", bed_of_file);
  write_file(folder, "a.csv", three_grains);
  const auto ensemble = [&](const std::string& frictions, const std::string& seeds, const std::string& jobs) {
    return run_talus({"ensemble", "bed.toml", "--set", "deposition.file=a.csv", "--vary",
                      "contact.friction=" + frictions, "--seeds", seeds, "--jobs", jobs, "-o", "e"},
                     folder.path());
  };
  ASSERT_EQ(ensemble("0.3", "1", "1").exit_code, 0);
  ASSERT_EQ(ensemble("0.3", "1-2", "0").exit_code, 0);
  write_file(folder, "a.csv", other_grains);
  const Outcome more = ensemble("0.3,0.5", "1", "1");
  EXPECT_EQ(more.exit_code, 65);
  EXPECT_NE(more.err.find("/a.csv (deposition.file) no longer holds the bed"), std::string::npos) << more.err;
  EXPECT_EQ(run_talus({"ensemble", "work", "e"}, folder.path()).exit_code, 0);
  EXPECT_NE(text_of(folder.path("e/contact.friction=0.3/seed-2.failed"))
                .find("/a.csv (deposition.file) no longer holds the bed"),
            std::string::npos);
  const Outcome replay = run_talus({"replay", "e/contact.friction=0.3/seed-1.h5"}, folder.path());
  EXPECT_EQ(replay.exit_code, 65);
  EXPECT_NE(replay.err.find("/a.csv (deposition.file) no longer holds the bed"), std::string::npos)
      << replay.err;
  write_file(folder, "a.csv", three_grains);
  EXPECT_EQ(run_talus({"replay", "e/contact.friction=0.3/seed-1.h5"}, folder.path()).exit_code, 0);
  EXPECT_EQ(run_talus({"ensemble", "retry", "e"}, folder.path()).exit_code, 0);
  EXPECT_EQ(ensemble("0.3,0.5", "1", "1").out.find("e: 4 of 4 done"), 0u);
}

// Another process may own the run and end; a member whose file is locked is therefore tried a second time.
TEST(EnsembleMembers, that_are_refused_their_file_are_tried_again_before_they_count_as_failed) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  std::filesystem::create_directories(folder.path("e/seed-1.h5"));
  const Outcome outcome = run_talus(ensemble_of("e", "1-2"), folder.path());
  EXPECT_EQ(outcome.exit_code, 73) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("failed: seed-1, exit code 73"), std::string::npos) << outcome.out;
  EXPECT_TRUE(std::filesystem::exists(folder.path("e/seed-2.h5")));
  std::stringstream log;
  log << std::ifstream(folder.path("e/seed-1.log")).rdbuf();
  const std::string said = log.str();
  const std::size_t first = said.find("talus: error: ");
  ASSERT_NE(first, std::string::npos) << said;
  EXPECT_NE(said.find("talus: error: ", first + 1), std::string::npos) << "twice: " << said;
  std::filesystem::remove(folder.path("e/seed-1.h5"));
  EXPECT_EQ(run_talus({"ensemble", "retry", "e"}, folder.path()).exit_code, 0);
  EXPECT_EQ(run_talus(ensemble_of("e", "1-2"), folder.path()).exit_code, 0);
}

TEST(EnsembleMembers, removes_no_run_outside_of_its_folder) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  std::vector<std::string> words = ensemble_of("e", "1");
  words.insert(words.end(), {"--vary", "contact.friction=0.5", "--keep", "all"});
  ASSERT_EQ(run_talus(words, folder.path()).exit_code, 0);
  std::filesystem::rename(folder.path("e/contact.friction=0.5"), folder.path("victim"));
  std::filesystem::rename(folder.path("e/scenarios/contact.friction=0.5.toml"), folder.path("e/victim.toml"));
  std::string manifest = text_of(folder.path("e/ensemble.manifest"));
  manifest.replace(manifest.find("contact.friction=0.5"), 20, "../victim");
  manifest.replace(manifest.find("keep all"), 8, "keep analysis");
  manifest.resize(manifest.rfind("hash "));
  manifest += "hash " + hash_text(hash_bytes(std::as_bytes(std::span(manifest)))) + "\n";
  write_file(folder, "e/ensemble.manifest", manifest);
  const Outcome work = run_talus({"ensemble", "work", "e"}, folder.path());
  EXPECT_EQ(work.exit_code, 65);
  EXPECT_TRUE(work.err.starts_with("e/ensemble.manifest:5:1: error: ")) << work.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path("victim/seed-1.h5")));
}

}  // namespace
}  // namespace talus::test
