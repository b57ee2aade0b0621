#include "app/unconverged_steps.h"

#include <gtest/gtest.h>

namespace talus::app {
namespace {

session::SolverRecord record_of(std::int64_t tilt) {
  session::SolverRecord record;
  record.unconverged_tilt = tilt;
  record.residual_max_rest = 6.6e-6;
  record.residual_max_moving = 2.1e-4;
  return record;
}

TEST(UnconvergedSteps, AreStatedWhereTheyAreFew) {
  const StepRemark remark = remark_on(record_of(16), 18041);
  EXPECT_TRUE(remark.usual);
  EXPECT_EQ(
      remark.text,
      "0.089 % of the steps did not reach their tolerance (largest residual 6.6e-06 at rest, 0.00021 while "
      "moving); this is usual (docs/solver.md).");
}

TEST(UnconvergedSteps, AreAWarningWhereTheyAreMany) {
  EXPECT_TRUE(remark_on(record_of(20), 10000).usual);
  const StepRemark remark = remark_on(record_of(21), 10000);
  EXPECT_FALSE(remark.usual);
  EXPECT_NE(remark.text.find("0 in the deposition, 21 in the tilt, 0 after failure"), std::string::npos);
  EXPECT_NE(remark.text.find("up to 0.2 % is usual"), std::string::npos);
  EXPECT_NE(remark.text.find("solver.max_iterations"), std::string::npos);
}

TEST(UnconvergedSteps, AreNotMentionedWhereThereAreNone) {
  EXPECT_EQ(remark_on(record_of(0), 1000).text, "");
  EXPECT_EQ(remark_on(session::SolverRecord(), 0).text, "");
}

}  // namespace
}  // namespace talus::app
