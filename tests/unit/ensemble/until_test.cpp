/// Stopping criterion of ensembles.

#include "ensemble/until.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/exit_code.h"

namespace talus::ensemble {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

MemberNumbers member_with(double theta_c) {
  return {"abc", "0.1.0 (def)", 1.5, {{"theta_c", "deg", theta_c}, {"theta_d/lc_jump[1]", "deg", none}}};
}

TEST(Precision, is_a_quantity_and_an_error) {
  const Precision precision = parse_precision("theta_d/lc_jump:0.25");
  EXPECT_EQ(precision.quantity, "theta_d/lc_jump");
  EXPECT_EQ(precision.error, 0.25);
  EXPECT_EQ(parse_precision("theta_d/lc_jump[1]:0.25").quantity, "theta_d/lc_jump[1]");
  EXPECT_EQ(parse_precision("lc/max@theta_d[1]:0.5").quantity, "lc/max@theta_d[1]");
  for (const char* text : {"", "theta_c", "theta_c:", ":0.2", "theta_c:-1", "theta_c:0", "theta_c:x",
                           "theta_c:0.2x", "theta_c[\nkeep analysis\n:1", "theta_c[:1", "theta_c[]:1",
                           "theta_c[x]:1", "theta_c[1]]:1", "lc/max:1", "lc/max@theta_x:1"})
    EXPECT_EQ(test::exit_code_of([&] { parse_precision(text); }), ExitCode::usage) << text;
}

TEST(Precision, is_reached_where_the_mean_of_every_variant_is_known_so_well) {
  const EnsemblePlan plan = plan_ensemble({1, 2, 3, 4, 5}, {{"a", "", {}}, {"b", "", {}}}, "none");
  std::vector<MemberNumbers> numbers;
  for (const double theta_c : {19.0, 20.0, 21.0, 20.0, 20.0})  // deviation 0.71, error 0.32
    numbers.insert(numbers.end(), {member_with(theta_c), member_with(theta_c)});
  EXPECT_TRUE(is_reached({"theta_c", 0.32}, plan, numbers));
  EXPECT_FALSE(is_reached({"theta_c", 0.31}, plan, numbers));
  numbers.back() = {};  // one member of variant b is not done, and four values are too few
  EXPECT_FALSE(is_reached({"theta_c", 10.0}, plan, numbers));
  EXPECT_FALSE(is_reached({"theta_d/lc_jump[1]", 10.0}, plan, numbers)) << "no member has a value";
}

TEST(Precision, of_what_no_run_has_is_refused_and_says_what_there_is) {
  try {
    parse_precision("theta_x:1");
    FAIL() << "nothing was rejected";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    for (const char* name : {"theta_x", "theta_c", "theta_d/dilation", "theta_r"})
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
  }
  EXPECT_EQ(parse_precision("theta_d/dilation[1]:1").quantity, "theta_d/dilation[1]");
}

}  // namespace
}  // namespace talus::ensemble
