/// Averages over the members of an ensemble, on common tilt grids.

#include "ensemble/averages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/trigonometry.h"
#include "ensemble/averages_file.h"
#include "support/blank_analysis.h"
#include "support/exit_code.h"

namespace talus::ensemble {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Returns a member whose z decreases from 4 by 1 per degree, with frames at 0, 1, 2 ... deg up to theta_c.
MemberResult member(std::uint64_t seed, double theta_c, double z = 4.0) {
  MemberResult result{seed, {"hash", "0.1.0", 1.0, {{"theta_c", "deg", theta_c}}}, {}};
  result.series.series = {{"contacts/coordination_number", "1", {}}};
  for (int k = 0; k <= theta_c; ++k) {
    result.series.theta.push_back(k);
    result.series.series[0].values.push_back(z - k);
  }
  return result;
}

TEST(Interpolated, lies_between_two_frames_and_nowhere_else) {
  const std::vector<double> tilts = {0.0, 1.0, 3.0}, values = {5.0, 7.0, 3.0};
  EXPECT_DOUBLE_EQ(interpolated(tilts, values, 0.5), 6.0);
  EXPECT_DOUBLE_EQ(interpolated(tilts, values, 2.5), 4.0);
  EXPECT_EQ(interpolated(tilts, values, 1.0), 7.0);
  EXPECT_EQ(interpolated(tilts, values, 3.0 + 1e-9), 3.0) << "the angle of a frame except for its rounding";
  EXPECT_EQ(interpolated(tilts, values, 1.0 - 1e-9), 7.0);
  for (const double outside : {-0.1, 3.1, none})
    EXPECT_TRUE(std::isnan(interpolated(tilts, values, outside))) << outside;
  EXPECT_TRUE(std::isnan(interpolated(tilts, {5.0, none, 3.0}, 0.5)));
  EXPECT_TRUE(std::isnan(interpolated({}, {}, 0.0)));
}

TEST(Averages, over_tilt_are_of_the_members_that_still_stand) {
  const Averages found = averages_of({member(1, 2.5, 4.0), member(2, 3.5, 6.0)}, 1.0);
  EXPECT_EQ(found.over_tilt.angles, (std::vector{0.0, 1.0, 2.0, 3.0}));
  const AveragedQuantity& z = found.over_tilt.quantities.at(0);
  EXPECT_EQ(z.name, "contacts/coordination_number");
  EXPECT_DOUBLE_EQ(z.summaries[0].statistics.mean, 5.0);
  EXPECT_DOUBLE_EQ(z.summaries[2].statistics.mean, 3.0);
  EXPECT_EQ(z.summaries[3].statistics.count, 1) << "member 1 has failed";
  EXPECT_DOUBLE_EQ(z.summaries[3].statistics.mean, 3.0);
  EXPECT_TRUE(std::isnan(z.values[3]));
}

TEST(Averages, before_failure_are_at_the_same_angle_from_each_theta_c) {
  const Averages found = averages_of({member(1, 2.5, 4.0), member(2, 3.5, 6.0)}, 1.0);
  EXPECT_EQ(found.before_failure.angles, (std::vector{0.0, 1.0, 2.0, 3.0}));
  const AveragedQuantity& z = found.before_failure.quantities.at(0);
  EXPECT_EQ(z.summaries[0].statistics.count, 0) << "no frame is at theta_c, and none is extrapolated";
  EXPECT_DOUBLE_EQ(z.values[1], 2.5);
  EXPECT_DOUBLE_EQ(z.values[5], 3.5);
  EXPECT_EQ(z.summaries[3].statistics.count, 1);
  MemberResult stands = member(3, 2.0);
  stands.numbers.numbers[0].value = none;
  EXPECT_TRUE(averages_of({stands}, 1.0).before_failure.quantities.empty()) << "it has not failed";
}

TEST(Averages, keep_every_member_in_its_place_where_quantities_differ) {
  MemberResult older = member(2, 3.0);
  older.series.series[0].name = "packing/volume";
  older.numbers.numbers = {{"first_slide", "deg", 1.0}};
  const Averages found = averages_of({member(1, 3.0), older}, 1.0);
  ASSERT_EQ(found.over_tilt.quantities.size(), 2u);
  for (const AveragedQuantity& quantity : found.over_tilt.quantities) {
    EXPECT_EQ(quantity.values.size(), 8u) << "two members, four points";
    EXPECT_EQ(quantity.summaries[0].statistics.count, 1) << quantity.name;
  }
  ASSERT_EQ(found.numbers.size(), 2u);
  EXPECT_TRUE(std::isnan(found.numbers[1].values[0]));
  EXPECT_EQ(found.numbers[1].values[1], 1.0);
}

TEST(Averages, correlate_angles_of_events_and_no_widths) {
  std::vector<MemberResult> members;
  for (int k = 1; k <= 4; ++k) {
    members.push_back(member(static_cast<std::uint64_t>(k), 2.0 + k));
    members.back().numbers.numbers.insert(members.back().numbers.numbers.end(),
                                          {{"theta_d/lc_jump", "deg", 10.0 - k},
                                           {"theta_d/lc_jump_error", "deg", 1.0 * k},
                                           {"lc/cut", "D", 40.0}});
  }
  const AngleCorrelations found = averages_of(members, 1.0).correlations;
  EXPECT_EQ(found.names, (std::vector<std::string>{"theta_c", "theta_d/lc_jump"}));
  ASSERT_EQ(found.pairs.size(), 4u);
  EXPECT_DOUBLE_EQ(found.pairs[0].coefficient, 1.0);
  EXPECT_DOUBLE_EQ(found.pairs[1].coefficient, -1.0);
  EXPECT_EQ(found.pairs[1].count, 4);
}

TEST(AveragesCsv, has_a_row_for_each_quantity_at_each_angle_with_values) {
  const std::string text =
      averages_csv({{"a, b", "", averages_of({member(1, 2.5, 4.0), member(2, 3.5, 6.0)}, 1.0)}});
  EXPECT_TRUE(text.starts_with(
      "variant,grid,angle (deg),quantity,unit,n,mean,deviation,error,low,high,lower_quartile,median,"
      "upper_quartile\n\"a, b\",run,,theta_c,deg,2,3,0.7071068,0.5,"))
      << text;
  EXPECT_NE(text.find("\"a, b\",over_tilt,3,contacts/coordination_number,1,1,3,,,,,3,3,3\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("before_failure,0,"), std::string::npos) << "no member has a value there";
  EXPECT_EQ(std::ranges::count(text, '\n'), 1 + 1 + 4 + 3);
}

TEST(MemberSeries, end_at_theta_c_and_have_units_of_tables) {
  analysis::Analysis analysis = test::blank_analysis({.frames = 3, .thresholds = 2});
  for (int k = 0; k < 3; ++k) {
    analysis::FrameRecord& frame = analysis.frames[static_cast<std::size_t>(k)];
    frame.tilt = radians(10.0 * k);
    frame.stress_ratio = 0.1 * k;
    frame.thresholds[1].lc_mean = 0.02 * (k + 1);
  }
  analysis.theta_c = radians(15.0);
  const MemberSeries found = member_series(analysis, 0.01);
  ASSERT_EQ(found.theta.size(), 2u);
  EXPECT_DOUBLE_EQ(found.theta[1], 10.0);
  const auto called = [&](const std::string& name) {
    return *std::ranges::find(found.series, name, &NamedSeries::name);
  };
  EXPECT_EQ(called("packing/stress_ratio").values, (std::vector{0.0, 0.1}));
  EXPECT_EQ(called("lc/mean[1]").unit, "D");
  EXPECT_DOUBLE_EQ(called("lc/mean[1]").values[1], 4.0);
  analysis.theta_c = none;
  EXPECT_EQ(member_series(analysis, 0.01).theta.size(), 3u);
}

TEST(MemberSeries, of_a_bed_that_slopes_to_the_other_side_are_mirrored) {
  analysis::Analysis analysis = test::blank_analysis({.frames = 3, .thresholds = 1});
  for (int k = 0; k < 3; ++k) {
    analysis::FrameRecord& frame = analysis.frames[static_cast<std::size_t>(k)];
    frame.tilt = radians(-10.0 * k);
    frame.sigma_t_over_n = -0.1 * k;
  }
  analysis.theta_c = radians(25.0);
  const MemberSeries found = member_series(analysis, 0.01);
  EXPECT_NEAR(found.theta[2], 20.0, 1e-12);
  const auto shear = std::ranges::find(found.series, "packing/sigma_t_over_n", &NamedSeries::name);
  EXPECT_DOUBLE_EQ(shear->values[2], 0.2);
}

}  // namespace
}  // namespace talus::ensemble
