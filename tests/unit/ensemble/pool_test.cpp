/// The pool: its processes are this test program, which is told which of its tests to run.

#include "ensemble/pool.h"

#include <gtest/gtest.h>

#include "io/durable_file.h"
#include "support/temporary_folder.h"

namespace talus {
namespace {

TEST(DISABLED_JobOfAPool, ends_well) {}
TEST(DISABLED_JobOfAPool, ends_with_an_error) { FAIL() << "as it should"; }

Job job(const std::string& test, const std::string& log) {
  return {test,
          {"--gtest_also_run_disabled_tests", "--gtest_filter=DISABLED_JobOfAPool." + test},
          log,
          test == "ends_well" ? 2.0 : 5.0};
}

TEST(Pool, does_all_jobs_and_returns_those_that_failed) {
  const test::TemporaryFolder folder;
  const std::string good = folder.path("a/b/good.log"), bad = folder.path("bad.log");
  const auto failed = run_jobs({job("ends_well", good), job("ends_with_an_error", bad)}, {"test", 2, 2, {}});
  ASSERT_EQ(failed.size(), 1u);
  EXPECT_EQ(failed[0].log, bad);
  EXPECT_EQ(failed[0].exit_code, 1);
  EXPECT_NE(read_text(bad).find("as it should"), std::string::npos);
  EXPECT_NE(read_text(good).find("1 test"), std::string::npos) << "its folder was made";
}

TEST(Pool, tells_how_far_it_is) {
  const test::TemporaryFolder folder;
  std::vector<PoolProgress> ends;
  const auto show = [&](const PoolProgress& progress) {
    if (progress.ended != nullptr) ends.push_back(progress);
  };
  const std::vector<Job> jobs = {job("ends_with_an_error", folder.path("1.log")),
                                 job("ends_well", folder.path("2.log"))};
  run_jobs(jobs, {"test", 1, 5, show});
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_EQ(ends[0].ended, &jobs[0]);
  EXPECT_EQ(ends[0].exit_code, 1);
  EXPECT_EQ(ends[0].done, 3u) << "three were complete before";
  EXPECT_EQ(ends[0].all, 5u);
  EXPECT_EQ(ends[0].running, 0u);
  EXPECT_DOUBLE_EQ(ends[0].seconds_left, 2.0) << "by the estimate alone: nothing has ended well yet";
  EXPECT_EQ(ends[1].exit_code, 0);
  EXPECT_EQ(ends[1].done, 4u);
  EXPECT_DOUBLE_EQ(ends[1].seconds_left, 0.0);
}

}  // namespace
}  // namespace talus
