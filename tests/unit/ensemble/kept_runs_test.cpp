/// Runs that go once their members are done.

#include "ensemble/kept_runs.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "io/run_store.h"
#include "support/exit_code.h"
#include "support/temporary_folder.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

EnsembleManifest manifest_with(const std::string& keep) {
  EnsembleManifest manifest;
  manifest.seeds = {3, 5, 8};
  manifest.variants = {{"", "", {}}};
  manifest.keep = keep;
  return manifest;
}

TEST(KeptRuns, are_all_none_or_those_of_the_lowest_seeds) {
  for (const char* all : {"", "all", "3", "4"})
    for (const std::uint64_t seed : {3, 5, 8}) EXPECT_TRUE(keeps_run(manifest_with(all), seed)) << all;
  for (const char* none : {"analysis", "0"})
    for (const std::uint64_t seed : {3, 5, 8}) EXPECT_FALSE(keeps_run(manifest_with(none), seed)) << none;
  EXPECT_TRUE(keeps_run(manifest_with("1"), 3));
  EXPECT_FALSE(keeps_run(manifest_with("1"), 5));
  EXPECT_TRUE(keeps_run(manifest_with("2"), 5));
  EXPECT_FALSE(keeps_run(manifest_with("2"), 8));
}

TEST(KeptRuns, have_no_other_name) {
  for (const char* bad : {"none", "-1", "1.5", "2 ", "frames"})
    EXPECT_EQ(test::exit_code_of([&] { check_keep(bad); }), ExitCode::usage) << bad;
  for (const char* good : {"", "all", "analysis", "0", "12"}) EXPECT_NO_THROW(check_keep(good)) << good;
}

class DroppedRuns : public testing::Test {
 protected:
  std::string touch(const std::string& name) {
    std::ofstream(folder_.path(name)) << "x";
    return folder_.path(name);
  }
  EnsemblePlan plan() const { return plan_of(manifest_with(""), folder_.path().string()); }

  test::TemporaryFolder folder_;
};

TEST_F(DroppedRuns, are_those_of_members_that_are_done_and_have_all_tables) {
  for (const char* name :
       {"seed-3.h5", "seed-3.csv", "seed-3.series.csv", "seed-3.lists.h5", "seed-5.h5", "seed-5.series.csv",
        "seed-5.lists.h5", "seed-8.h5", "seed-8.csv", "seed-8.series.csv"})
    touch(name);
  EXPECT_EQ(drop_runs(manifest_with(""), plan(), folder_.path()), 0u);
  EXPECT_EQ(drop_runs(manifest_with("1"), plan(), folder_.path()), 0u) << "seed 3 keeps its run";
  EXPECT_EQ(drop_runs(manifest_with("analysis"), plan(), folder_.path()), 1u);
  EXPECT_FALSE(fs::exists(folder_.path("seed-3.h5")));
  EXPECT_TRUE(fs::exists(folder_.path("seed-3.csv")) && fs::exists(folder_.path("seed-3.series.csv")));
  EXPECT_TRUE(fs::exists(folder_.path("seed-5.h5"))) << "a member that is not done";
  EXPECT_TRUE(fs::exists(folder_.path("seed-8.h5"))) << "one whose lists are made from its run only";
  EXPECT_EQ(drop_runs(manifest_with("analysis"), plan(), folder_.path()), 0u);
}

TEST_F(DroppedRuns, are_none_behind_a_link) {
  const std::string ensemble = folder_.path("e");
  fs::create_directory(folder_.path("victim"));
  for (const char* name : {"seed-3.h5", "seed-3.csv", "seed-3.series.csv", "seed-3.lists.h5"})
    touch(std::string("victim/") + name);
  fs::create_symlink(folder_.path("victim"), ensemble);
  const EnsemblePlan behind = plan_of(manifest_with("analysis"), ensemble);
  EXPECT_EQ(drop_runs(manifest_with("analysis"), behind, folder_.path()), 1u)
      << "the link is the folder's own";
  touch("victim/seed-3.h5");
  fs::create_directory(folder_.path("own"));
  EXPECT_EQ(drop_runs(manifest_with("analysis"), behind, folder_.path("own")), 0u);
  EXPECT_TRUE(fs::exists(folder_.path("victim/seed-3.h5")));
}

TEST_F(DroppedRuns, leave_no_folder_behind) {
  for (const char* name : {"seed-3.h5", "seed-3.csv", "seed-3.series.csv"}) touch(name);
  fs::create_directory(run_folder(folder_.path("seed-3.h5")));
  drop_run(plan().members[0]);
  EXPECT_FALSE(fs::exists(run_folder(folder_.path("seed-3.h5"))));
  EXPECT_FALSE(fs::exists(folder_.path("seed-3.h5")));
  EXPECT_NO_THROW(drop_run(plan().members[0])) << "another worker may have been faster";
}

}  // namespace
}  // namespace talus
