/// Progress of members, from the names of files.

#include "ensemble/member_state.h"

#include <gtest/gtest.h>

#include <fstream>

#include "support/temporary_folder.h"

namespace talus::ensemble {
namespace {

void touch(const std::string& path) { std::ofstream file(path); }

TEST(MemberState, follows_from_the_files_beside_the_run) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path("a"));
  const EnsemblePlan plan =
      plan_ensemble({1, 2, 3, 4}, {{"a", "", {}}, {"b", "", {}}}, folder.path().string());
  touch(folder.path("a/seed-1.h5"));
  touch(folder.path("a/seed-1.claim-0"));  // its worker has not released it yet
  touch(folder.path("a/seed-2.failed"));
  touch(folder.path("a/seed-3.claim-2"));
  touch(folder.path("a/seed-3.claim-10"));
  touch(folder.path("a/seed-4.csv"));  // leftover of an earlier file layout
  std::filesystem::create_directory(folder.path("a/seed-4.h5.run"));
  std::filesystem::create_directory(folder.path("a/seed-2.h5"));
  const std::vector<MemberState> states = scan_members(plan);
  ASSERT_EQ(states.size(), 8u);
  EXPECT_EQ(states[0].stage, MemberStage::done);
  EXPECT_EQ(states[2].stage, MemberStage::failed);
  EXPECT_EQ(states[4].stage, MemberStage::claimed);
  EXPECT_EQ(states[4].claim, 10);
  EXPECT_EQ(states[6].stage, MemberStage::waiting);
  EXPECT_EQ(states[1].stage, MemberStage::waiting) << "folder b does not exist yet";
  EXPECT_EQ(count_of(states, MemberStage::waiting), 5u);
  EXPECT_TRUE(states[6].has_folder && states[6].has_old_table);
  EXPECT_FALSE(states[0].has_folder || states[0].has_old_table);
}

TEST(MemberFailure, is_read_back_and_harmless) {
  const test::TemporaryFolder folder;
  const std::string run = folder.path("seed-1.h5");
  record_failure(run, {65, "bad \x1b[2J"});
  const MemberFailure failure = read_failure(run);
  EXPECT_EQ(failure.exit_code, 65);
  EXPECT_EQ(failure.message, "bad \\x1b[2J");
}

TEST(MemberFailure, has_the_last_line_of_a_log_that_says_something) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path("log")) << "first\nlast\n \n\n";
  EXPECT_EQ(last_line_of(folder.path("log")), "last");
  touch(folder.path("empty"));
  EXPECT_EQ(last_line_of(folder.path("empty")), "");
}

}  // namespace
}  // namespace talus::ensemble
