/// Distributions and other lists of members, and averages without single members.

#include "ensemble/list_averages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "analysis/quantities.h"
#include "core/trigonometry.h"
#include "ensemble/averages_file.h"
#include "io/hdf5_reader.h"
#include "support/blank_analysis.h"
#include "support/exit_code.h"
#include "support/temporary_folder.h"

namespace talus::ensemble {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Returns frames at 0, 1, 2 ... deg up to theta_c with the densities {d + theta, 10 d + theta}.
MemberLists member(double theta_c, double d) {
  MemberLists lists{
      {}, {{"gamma/edge", "1", "edges", 3, {0.0, 0.5, 1.0}}}, {{"gamma/density", "1", "pdf", 2, {}}}};
  for (int k = 0; k <= theta_c; ++k) {
    lists.theta.push_back(k);
    lists.lists[0].values.push_back(d + k);
    lists.lists[0].values.push_back(10.0 * d + k);
  }
  return lists;
}

ListAverages averages_of_two() {
  ListAverages averages;
  add_member(averages, member(2.5, 1.0), 2.5, 1.0);
  add_member(averages, member(3.5, 3.0), 3.5, 1.0);
  return averages;
}

TEST(ListAverages, are_number_by_number_over_the_members_that_still_stand) {
  const ListAverages found = averages_of_two();
  const AveragedList& density = found.over_tilt.at(0);
  EXPECT_EQ(density.name, "gamma/density");
  ASSERT_EQ(density.mean.size(), 4u * 2u) << "0, 1, 2 and 3 deg";
  EXPECT_DOUBLE_EQ(density.mean[0], 2.0);
  EXPECT_DOUBLE_EQ(density.mean[1], 20.0);
  EXPECT_DOUBLE_EQ(density.mean[2 * 2 + 1], 22.0);
  EXPECT_EQ(density.count[2 * 2], 2.0);
  EXPECT_EQ(density.count[3 * 2], 1.0) << "member 1 has failed";
  EXPECT_DOUBLE_EQ(density.mean[3 * 2], 6.0);
  EXPECT_NEAR(deviation_of(density)[1], std::sqrt(200.0), 1e-12);
  EXPECT_TRUE(std::isnan(deviation_of(density)[3 * 2]));
}

TEST(ListAverages, before_failure_are_at_the_same_angle_from_each_theta_c) {
  const ListAverages found = averages_of_two();
  const AveragedList& density = found.before_failure.at(0);
  EXPECT_EQ(density.count[0], 0.0) << "theta_c is beyond the last frame";
  EXPECT_TRUE(std::isnan(density.mean[0]));
  EXPECT_DOUBLE_EQ(density.mean[1 * 2], 0.5 * ((1.0 + 1.5) + (3.0 + 2.5)));
  EXPECT_EQ(density.count[3 * 2], 1.0) << "member 1 was never this far from its failure";
}

TEST(ListAverages, leave_out_members_with_other_bins) {
  ListAverages averages = averages_of_two();
  MemberLists other = member(2.5, 100.0);
  other.bins[0].values[1] = 0.4;
  add_member(averages, other, 2.5, 1.0);
  EXPECT_EQ(averages.over_tilt[0].count[0], 2.0);
  add_member(averages, {}, none, 1.0);
  EXPECT_EQ(averages.over_tilt[0].count[0], 2.0) << "one without frames";
}

TEST(ListAverages, stand_in_the_file_with_their_bins) {
  const test::TemporaryFolder folder;
  Averages numbers;
  numbers.over_tilt.angles = {0.0, 1.0, 2.0, 3.0, 4.0};
  write_averages(folder.path("e.h5"), {{"", "seed = 1\n", numbers, averages_of_two()}}, "0.1.0");
  io::hdf5::Reader file = io::hdf5::Reader::from_file(folder.path("e.h5"));
  const auto values = [&](const std::string& path, const char* shape) {
    const io::DataSetField field{"/variants/0/" + path, io::ElementType::float64, shape, "", ""};
    return file.read<double>(field, io::hdf5::any_number);
  };
  EXPECT_EQ(values("bins/gamma/edge", "3"), (std::vector{0.0, 0.5, 1.0}));
  EXPECT_DOUBLE_EQ(values("over_tilt/gamma/density/mean", "5 2")[1], 20.0);
  EXPECT_EQ(values("over_tilt/gamma/density/n", "5 2")[4 * 2], 0.0) << "no member reached 4 deg";
  EXPECT_TRUE(std::isnan(values("over_tilt/gamma/density/mean", "5 2")[4 * 2]));
  EXPECT_NEAR(values("over_tilt/gamma/density/deviation", "5 2")[0], std::sqrt(2.0), 1e-12);
}

/// Returns an analysis with different numbers in every list of the table of quantities.
analysis::Analysis filled_analysis() {
  analysis::Analysis analysis =
      test::blank_analysis({.frames = 3, .thresholds = 2, .sections = 4, .bins = 5});
  int next = 1;
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    if (!analysis::is_list_of_frame(quantity)) continue;
    analysis::Values values = analysis::values_of(quantity, analysis);
    std::visit(
        [&]<typename T>(std::vector<T>& numbers) {
          for (T& number : numbers) number = static_cast<T>(next++);
        },
        values);
    analysis::set_values(quantity, values, analysis);
  }
  for (analysis::FrameRecord& frame : analysis.frames) frame.tilt = radians(static_cast<double>(next++));
  return analysis;
}

TEST(MemberLists, end_at_theta_c_and_leave_out_directions_and_grains) {
  analysis::Analysis analysis = filled_analysis();
  analysis.theta_c = analysis.frames[1].tilt;
  const MemberLists found = member_lists(analysis, 0.25);
  EXPECT_EQ(found.theta.size(), 2u);
  EXPECT_GT(found.lists.size(), 12u);
  for (const NamedList& list : found.lists) {
    EXPECT_EQ(list.values.size(), 2 * list.width) << list.name;
    EXPECT_NE(list.unit, "deg") << list.name;
    EXPECT_NE(list.name, "lc/length");
  }
}

}  // namespace
}  // namespace talus::ensemble
