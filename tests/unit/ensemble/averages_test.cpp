/// Averages over the members of an ensemble on common grids, and their files.

#include "ensemble/averages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/quantities.h"
#include "core/trigonometry.h"
#include "io/durable_file.h"
#include "io/hdf5_file.h"
#include "support/blank_analysis.h"
#include "support/exit_code.h"
#include "support/has.h"
#include "support/temporary_folder.h"

namespace talus::ensemble {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double diameter = 0.01;  // m

/// Returns a member whose z decreases from 4 by 1 per degree, with frames at 0, 1, 2 ... deg up to theta_c,
/// and the densities of gamma {d + theta, 10 d + theta}.
MemberResult member(std::uint64_t seed, double theta_c, double z = 4.0, double d = 1.0) {
  MemberResult result{seed, {"00000000000000ab", "0.1.0", 1.0, {{"theta_c", theta_c}}}, {}, diameter};
  result.analysis = test::blank_analysis({.frames = static_cast<std::size_t>(theta_c) + 1, .bins = 2});
  result.analysis.theta_c = radians(theta_c);
  for (const analysis::Quantity& quantity : analysis::quantities())
    if (analysis::is_list_of_run(quantity))
      analysis::set_values(quantity, std::vector<double>(), result.analysis);
  result.analysis.gamma_edge = {0.0, 0.5, 1.0};
  for (std::size_t k = 0; k < result.analysis.frames.size(); ++k) {
    analysis::FrameRecord& frame = result.analysis.frames[k];
    const auto theta = static_cast<double>(k);
    frame.tilt = radians(theta);
    frame.coordination_number = z - theta;
    frame.gamma_density = {d + theta, 10.0 * d + theta};
  }
  return result;
}

/// Returns a member whose slope has not failed.
MemberResult standing(std::uint64_t seed, double end_angle) {
  MemberResult result = member(seed, end_angle);
  result.analysis.theta_c = result.numbers.numbers[0].second = none;
  return result;
}

VariantAverages averages_of(const std::vector<MemberResult>& members) {
  std::vector<const MemberResult*> pointers;
  for (const MemberResult& each : members) pointers.push_back(&each);
  return averages_of("a, b", "seed = 1\n", std::move(pointers), 1.0);
}

const AveragedQuantity* find(const AveragedCurves& curves, const std::string& name) {
  const auto found = std::ranges::find(curves.quantities, name, &AveragedQuantity::name);
  return found == curves.quantities.end() ? nullptr : &*found;
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
  const std::vector<MemberResult> members = {member(1, 2.5, 4.0), member(2, 3.5, 6.0)};
  const VariantAverages found = averages_of(members);
  EXPECT_EQ(found.over_tilt.angles, (std::vector{0.0, 1.0, 2.0, 3.0}));
  const AveragedQuantity& z = *find(found.over_tilt, "contacts/coordination_number");
  EXPECT_EQ(z.summaries.size(), 4u);
  EXPECT_DOUBLE_EQ(z.summaries[0].statistics.mean, 5.0);
  EXPECT_DOUBLE_EQ(z.summaries[2].statistics.mean, 3.0);
  EXPECT_EQ(z.summaries[3].statistics.count, 1) << "member 1 has failed";
  EXPECT_DOUBLE_EQ(z.summaries[3].statistics.mean, 3.0);
}

TEST(Averages, before_failure_are_at_the_same_angle_from_each_theta_c) {
  const std::vector<MemberResult> members = {member(1, 2.5, 4.0), member(2, 3.5, 6.0)};
  const VariantAverages found = averages_of(members);
  EXPECT_EQ(found.before_failure.angles, (std::vector{0.0, 1.0, 2.0, 3.0}));
  const AveragedQuantity& z = *find(found.before_failure, "contacts/coordination_number");
  EXPECT_EQ(z.summaries[0].statistics.count, 0) << "no frame is at theta_c, and none is extrapolated";
  EXPECT_DOUBLE_EQ(z.summaries[1].statistics.mean, 0.5 * (2.5 + 3.5));
  EXPECT_EQ(z.summaries[3].statistics.count, 1);
  EXPECT_DOUBLE_EQ(z.summaries[3].statistics.mean, 5.5) << "member 1 was never this far from its failure";
  const std::vector<MemberResult> stands = {standing(3, 2.0)};
  EXPECT_TRUE(averages_of(stands).before_failure.quantities.empty()) << "it has not failed";
}

TEST(Averages, are_of_the_members_that_have_a_quantity) {
  MemberResult with_thresholds = member(2, 3.0);
  with_thresholds.analysis.thresholds.resize(2);
  for (analysis::FrameRecord& frame : with_thresholds.analysis.frames) {
    frame.thresholds.resize(2);
    frame.thresholds[1].lc_mean = 4.0 * diameter;
  }
  with_thresholds.numbers.numbers = {{"first_slide", 1.0}, {"lc/cut", 40.0}};
  const std::vector<MemberResult> members = {member(1, 3.0), with_thresholds};
  const VariantAverages found = averages_of(members);
  const AveragedQuantity& length = *find(found.over_tilt, "lc/mean[1]");
  EXPECT_EQ(length.unit, "D");
  EXPECT_EQ(length.summaries.at(0).statistics.count, 1);
  EXPECT_DOUBLE_EQ(length.summaries.at(0).statistics.mean, 4.0);
  ASSERT_EQ(found.numbers.size(), 3u);
  EXPECT_EQ(found.numbers[1].name, "first_slide");
  EXPECT_EQ(found.numbers[1].unit, "deg");
  EXPECT_EQ(found.numbers[2].unit, "D");
  for (const AveragedQuantity& number : found.numbers)
    EXPECT_EQ(number.summaries.at(0).statistics.count, 1) << number.name;
}

TEST(Averages, end_at_theta_c_and_are_mirrored_for_a_bed_that_slopes_to_the_other_side) {
  MemberResult backwards = member(1, 3.0);
  for (analysis::FrameRecord& frame : backwards.analysis.frames) {
    frame.sigma_t_over_n = -frame.tilt;
    frame.tilt *= -1.0;
  }
  backwards.analysis.theta_c = radians(2.5);
  const std::vector<MemberResult> members = {backwards};
  const VariantAverages found = averages_of(members);
  EXPECT_EQ(found.over_tilt.angles, (std::vector{0.0, 1.0, 2.0}));
  const AveragedQuantity& shear = *find(found.over_tilt, "packing/sigma_t_over_n");
  EXPECT_DOUBLE_EQ(shear.summaries[2].statistics.mean, radians(2.0));
}

TEST(Averages, of_lists_are_number_by_number) {
  const std::vector<MemberResult> members = {member(1, 2.5, 4.0, 1.0), member(2, 3.5, 4.0, 3.0)};
  const VariantAverages found = averages_of(members);
  const AveragedQuantity& density = *find(found.over_tilt, "gamma/density");
  EXPECT_TRUE(density.is_list);
  ASSERT_EQ(density.summaries.size(), 4u * 2u) << "0, 1, 2 and 3 deg";
  EXPECT_DOUBLE_EQ(density.summaries[0].statistics.mean, 2.0);
  EXPECT_DOUBLE_EQ(density.summaries[1].statistics.mean, 20.0);
  EXPECT_DOUBLE_EQ(density.summaries[2 * 2 + 1].statistics.mean, 22.0);
  EXPECT_NEAR(density.summaries[1].statistics.deviation, std::sqrt(200.0), 1e-12);
  EXPECT_EQ(density.summaries[3 * 2].statistics.count, 1) << "member 1 has failed";
  EXPECT_DOUBLE_EQ(density.summaries[3 * 2].statistics.mean, 6.0);
  EXPECT_TRUE(std::isnan(density.summaries[3 * 2].statistics.deviation));
  const AveragedQuantity& before = *find(found.before_failure, "gamma/density");
  EXPECT_EQ(before.summaries[0].statistics.count, 0) << "theta_c is beyond the last frame";
  EXPECT_DOUBLE_EQ(before.summaries[1 * 2].statistics.mean, 0.5 * ((1.0 + 1.5) + (3.0 + 2.5)));
}

TEST(Averages, of_lists_leave_out_members_with_other_bins_or_without_frames) {
  MemberResult other = member(3, 2.5, 4.0, 100.0), empty = member(4, 2.5);
  other.analysis.gamma_edge[1] = 0.4;
  empty.analysis.frames.clear();
  const std::vector<MemberResult> members = {empty, member(1, 2.5), member(2, 3.5), other};
  EXPECT_EQ(find(averages_of(members).over_tilt, "gamma/density")->summaries[0].statistics.count, 2);
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
  for (std::size_t k = 0; k < 3; ++k) analysis.frames[k].tilt = radians(static_cast<double>(k));
  return analysis;
}

TEST(Averages, of_lists_leave_out_grains_and_all_leave_out_directions) {
  MemberResult only = standing(1, 2.0);
  only.analysis = filled_analysis();
  const std::vector<MemberResult> members = {only};
  const VariantAverages found = averages_of(members);
  int lists = 0;
  for (const AveragedQuantity& list : found.over_tilt.quantities) {
    EXPECT_NE(list.unit, "deg") << list.name;
    if (!list.is_list) continue;
    ++lists;
    EXPECT_EQ(list.summaries.size(), 3 * list.width) << list.name;
    EXPECT_NE(list.name, "lc/length");
  }
  EXPECT_GT(lists, 12);
}

TEST(AveragesCsv, has_a_row_for_each_quantity_at_each_angle_with_values) {
  const std::vector<MemberResult> members = {member(1, 2.5, 4.0), member(2, 3.5, 6.0)};
  const std::string text = averages_csv({averages_of(members)});
  EXPECT_TRUE(text.starts_with(
      "variant,grid,angle (deg),quantity,unit,n,mean,deviation,error,low,high,lower_quartile,median,"
      "upper_quartile\n\"a, b\",run,,theta_c,deg,2,3,0.7071068,0.5,"))
      << text;
  EXPECT_TRUE(test::has(text, "\"a, b\",over_tilt,3,contacts/coordination_number,1,1,3,,,,,3,3,3\n"));
  EXPECT_FALSE(test::has(text, "before_failure,0,")) << "no member has a value there";
  EXPECT_FALSE(test::has(text, "gamma/density")) << "lists are in ensemble.h5";
  EXPECT_EQ(test::count_of(text, "coordination_number,"), 4u + 3u);
}

class AveragesFile : public testing::Test {
 protected:
  void write(const std::vector<MemberResult>& members) {
    VariantAverages averages = averages_of(members);
    averages.name = "a";
    write_averages(path, {averages}, "0.1.0");
  }
  ExitCode refusal() const {
    return test::exit_code_of([&] { read_averages(path); });
  }

  test::TemporaryFolder folder;
  const std::string path = folder.path("e.h5");
};

TEST_F(AveragesFile, has_means_bins_and_correlations) {
  std::vector<MemberResult> members;
  for (int k = 1; k <= 4; ++k) {
    members.push_back(member(static_cast<std::uint64_t>(k), 2.5 + k, 4.0, 1.0));
    members.back().numbers.numbers.insert(
        members.back().numbers.numbers.end(),
        {{"theta_d/lc_jump", 10.0 - k}, {"theta_d/lc_jump_error", 1.0 * k}, {"lc/cut", 40.0}});
  }
  write(members);
  io::hdf5::Reader file = io::hdf5::Reader::from_file(path);
  const auto values = [&](const std::string& name, const char* shape) {
    const io::DataSetField field{"/variants/0/" + name, io::ElementType::float64, shape, "", ""};
    return file.read<double>(field, io::hdf5::any_number);
  };
  EXPECT_EQ(values("bins/gamma/edge", "3"), (std::vector{0.0, 0.5, 1.0}));
  EXPECT_DOUBLE_EQ(values("over_tilt/gamma/density/mean", "7 2")[1], 10.0);
  EXPECT_EQ(values("over_tilt/gamma/density/n", "7 2")[6 * 2], 1.0) << "one member reached 6 deg";
  EXPECT_TRUE(std::isnan(values("over_tilt/gamma/density/deviation", "7 2")[6 * 2]));
  EXPECT_EQ(values("over_tilt/contacts/coordination_number/summary", "7 9")[1], 4.0);
  EXPECT_EQ(values("numbers/theta_c/values", "4 1")[3], 6.5);
  const std::vector<double> pairs = values("correlations/coefficient", "2 2");
  EXPECT_DOUBLE_EQ(pairs[0], 1.0) << "theta_c with itself";
  EXPECT_DOUBLE_EQ(pairs[1], -1.0) << "theta_c with theta_d, and no width or length";
  EXPECT_EQ(values("correlations/n", "2 2")[1], 4.0);
}

/// Expects that two analyses have the same scalars, bit for bit.
void expect_same_scalars(const analysis::Analysis& left, const analysis::Analysis& right) {
  const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  ASSERT_EQ(left.thresholds.size(), right.thresholds.size());
  ASSERT_EQ(left.frames.size(), right.frames.size());
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    if (analysis::is_number_of_run(quantity)) {
      for (std::size_t k = 0; k < 2; ++k)
        EXPECT_TRUE(same(number_of(quantity, left, k), number_of(quantity, right, k))) << quantity.name;
    }
    for (std::size_t k = 0; k < left.frames.size(); ++k)
      for (std::size_t f = 0; f < 2; ++f)
        EXPECT_TRUE(same(number_of(quantity, left.frames[k], f), number_of(quantity, right.frames[k], f)))
            << quantity.name;
  }
}

TEST_F(AveragesFile, gives_back_all_single_numbers_of_the_analyses) {
  MemberResult first = member(1, 3.0);
  first.analysis = test::blank_analysis({.frames = 3, .thresholds = 2, .bins = 2});
  first.analysis.theta_c = radians(15.0);
  first.analysis.lc_cut = 40.0 * diameter;
  first.analysis.dilation = {radians(3.0), none};
  for (std::size_t f = 0; f < 2; ++f) {
    first.analysis.thresholds[f].factor = 1.0 + static_cast<double>(f);
    first.analysis.thresholds[f].lc_jump = radians(10.0 + static_cast<double>(f));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    analysis::FrameRecord& frame = first.analysis.frames[k];
    frame.tilt = radians(5.0 * static_cast<double>(k));
    frame.volume_strain = 0.001 * static_cast<double>(k);
    frame.critical_correlation_length = 3.0 * diameter;
    frame.thresholds[1].lc_mean = diameter * (4.0 + static_cast<double>(k));
    frame.thresholds[0].cluster_count = static_cast<Index>(7 + k);
  }
  first.numbers.numbers.emplace_back("theta_r", 12.0);
  const std::vector<MemberResult> members = {first, standing(2, 4.0)};
  write(members);
  const std::vector<runs::RunView> runs = read_averages(path);
  ASSERT_EQ(runs.size(), 2u);
  for (std::size_t m = 0; m < 2; ++m) {
    SCOPED_TRACE(m);
    EXPECT_EQ(runs[m].scenario_text, "seed = 1\n");
    EXPECT_EQ(runs[m].scenario.seed, members[m].seed);
    EXPECT_EQ(runs[m].state_hash, "00000000000000ab");
    EXPECT_FALSE(runs[m].file);
    expect_same_scalars(runs[m].analysis, members[m].analysis);
    for (std::size_t k = 0; k < runs[m].analysis.frames.size(); ++k)
      EXPECT_EQ(runs[m].analysis.frames[k].tilt, members[m].analysis.frames[k].tilt);
  }
  EXPECT_EQ(runs[0].path, path + "#a/seed-1");
  EXPECT_DOUBLE_EQ(degrees(runs[0].theta_r), 12.0);
  EXPECT_TRUE(std::isnan(runs[1].theta_r));
}

TEST_F(AveragesFile, has_room_for_thousands_of_members) {
  std::vector<MemberResult> members;
  for (std::uint64_t seed = 1; seed <= 5000; ++seed)
    members.push_back({seed, {"00000000000000ab", "", 0.0, {{"theta_c", static_cast<double>(seed)}}}});
  write(members);
  const std::vector<runs::RunView> runs = read_averages(path);
  ASSERT_EQ(runs.size(), 5000u) << "more than an HDF5 attribute can hold";
  EXPECT_EQ(runs.back().scenario.seed, 5000u);
}

TEST_F(AveragesFile, of_another_kind_or_version_is_refused) {
  io::write_text(path, "talus run file 1\n");
  EXPECT_FALSE(io::begins_as_averages(path));
  EXPECT_FALSE(io::begins_as_averages(folder.path("none")));
  EXPECT_EQ(refusal(), ExitCode::bad_data);
  io::write_text(path, "talus averages file 1\n");
  EXPECT_TRUE(io::begins_as_averages(path));
  EXPECT_EQ(refusal(), ExitCode::bad_data);
}

/// Writes a file of one variant with two seeds, values of theta_c, and frames at two tilts.
template <typename T>
void write_angles(const std::string& path, io::ElementType type, const std::vector<T>& theta_c,
                  const std::vector<std::uint64_t>& frames) {
  io::hdf5::Writer file({}, io::seal_size);
  file.set_attribute("/variants/0", "name", "");
  file.set_attribute("/variants/0", "scenario", "");
  const auto shape = [](const auto& values) { return std::to_string(values.size()); };
  for (const char* name : {"/variants/0/seed", "/variants/0/state_hash"})
    file.write(io::DataSetField{name, io::ElementType::uint64, "2", "1", ""},
               std::vector<std::uint64_t>{1, 2});
  file.write(io::DataSetField{"/variants/0/analysis/frames", io::ElementType::uint64, shape(frames), "1", ""},
             frames);
  file.write(io::DataSetField{"/variants/0/analysis/tilt", io::ElementType::float64, "2", "rad", ""},
             std::vector<double>{0.0, 0.1});
  file.write(io::DataSetField{"/variants/0/analysis/theta_c", type, shape(theta_c), "rad", ""}, theta_c);
  io::write_durably(path, io::sealed(file.image(), io::averages_seal));
}

TEST_F(AveragesFile, of_which_parts_disagree_is_refused) {
  using enum io::ElementType;
  const std::vector<double> both = {0.3, 0.4};
  write_angles(path, float64, both, {1, 1});
  EXPECT_EQ(read_averages(path).at(1).analysis.theta_c, 0.4);
  write_angles(path, float64, std::vector<double>{0.3}, {1, 1});
  EXPECT_EQ(refusal(), ExitCode::bad_data) << "a member without its number";
  write_angles(path, uint64, std::vector<std::uint64_t>{19, 20}, {1, 1});
  EXPECT_EQ(refusal(), ExitCode::bad_data) << "numbers of another kind";
  write_angles(path, float64, std::vector<double>{0.3, std::numeric_limits<double>::infinity()}, {1, 1});
  EXPECT_EQ(refusal(), ExitCode::bad_data) << "an infinite value";
  for (const std::vector<std::uint64_t>& frames :
       {std::vector<std::uint64_t>{1, 0}, {1, 2}, {1}, {1, std::numeric_limits<std::uint64_t>::max()}}) {
    write_angles(path, float64, both, frames);
    EXPECT_EQ(refusal(), ExitCode::bad_data) << "frames that are not those of the tilts";
  }
}

}  // namespace
}  // namespace talus::ensemble
