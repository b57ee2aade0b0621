/// Values of members read back from ensemble.h5, and the analysis parameters that they record.

#include "ensemble/averages_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/trigonometry.h"
#include "ensemble/averages_file.h"
#include "io/durable_file.h"
#include "io/hdf5_writer.h"
#include "io/seal.h"
#include "support/blank_analysis.h"
#include "support/exit_code.h"
#include "support/temporary_folder.h"

namespace talus::ensemble {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Returns a member with frames at 0, 1, 2 ... deg, and one 0.25 deg before theta_c.
MemberResult member(std::uint64_t seed, double theta_c) {
  MemberResult result{seed, {"00000000000000ab", "0.1.0", 1.0, {{"theta_c", "deg", theta_c}}}, {}};
  for (int k = 0; k < theta_c - 0.25; ++k) result.series.theta.push_back(k);
  result.series.theta.push_back(theta_c - 0.25);
  result.series.series = {{"contacts/coordination_number", "1", {}}, {"gamma/mean", "1", {}}};
  for (const double theta : result.series.theta) {
    result.series.series[0].values.push_back(static_cast<double>(seed) - theta * theta);
    result.series.series[1].values.push_back(theta > 0.5 ? theta : none);
  }
  return result;
}

StoredVariant written_and_read(const std::vector<MemberResult>& members, double frame_every = 1.0) {
  const test::TemporaryFolder folder;
  write_averages(folder.path("e.h5"), {{"a", "seed = 1\n", averages_of(members, frame_every)}}, "0.1.0");
  const std::vector<StoredVariant> variants = read_averages(folder.path("e.h5"));
  EXPECT_EQ(variants.size(), 1u);
  return variants.at(0);
}

TEST(ReadAverages, gives_members_back_at_the_points_of_both_grids) {
  const StoredVariant variant = written_and_read({member(1, 2.5), member(2, 4.5)});
  EXPECT_EQ(variant.name, "a");
  EXPECT_EQ(variant.scenario, "seed = 1\n");
  const MemberResult second = member_of(variant, 1);
  EXPECT_EQ(second.seed, 2u);
  EXPECT_EQ(second.numbers.state_hash, "00000000000000ab");
  EXPECT_EQ(number_called(second.numbers, "theta_c"), 4.5);
  // No grid point is at 4.25 deg: the last known value is at 4 deg, and there is none at 4.5 deg.
  EXPECT_EQ(second.series.theta, (std::vector{0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0}));
  ASSERT_EQ(second.series.series.size(), 2u);
  const MemberResult original = member(2, 4.5);
  for (std::size_t k = 0; k < second.series.theta.size(); ++k)
    EXPECT_DOUBLE_EQ(
        second.series.series[0].values[k],
        interpolated(original.series.theta, original.series.series[0].values, second.series.theta[k]))
        << second.series.theta[k];
  EXPECT_EQ(second.series.series[0].name, "contacts/coordination_number");
  EXPECT_TRUE(std::isnan(second.series.series[1].values[0])) << "an unknown value stays unknown";
  EXPECT_EQ(member_of(variant, 0).series.theta.back(), 2.0);
}

TEST(ReadAverages, of_values_that_were_averaged_again_are_the_same) {
  const std::vector<MemberResult> members = {member(1, 2.5), member(2, 4.5)};
  const StoredVariant once = written_and_read(members);
  const StoredVariant twice = written_and_read({member_of(once, 0), member_of(once, 1)});
  ASSERT_EQ(twice.over_tilt.size(), once.over_tilt.size());
  for (std::size_t q = 0; q < once.over_tilt.size(); ++q)
    for (std::size_t k = 0; k < once.over_tilt[q].values.size(); ++k)
      EXPECT_TRUE(once.over_tilt[q].values[k] == twice.over_tilt[q].values[k] ||
                  std::isnan(once.over_tilt[q].values[k]))
          << once.over_tilt[q].name << " " << k;
}

TEST(ReadAverages, has_room_for_thousands_of_members) {
  std::vector<MemberResult> members;
  for (std::uint64_t seed = 1; seed <= 5000; ++seed)
    members.push_back(
        {seed, {"00000000000000ab", "", 0.0, {{"theta_c", "deg", static_cast<double>(seed)}}}, {}});
  const StoredVariant variant = written_and_read(members);
  ASSERT_EQ(variant.state_hashes.size(), 5000u) << "more than an HDF5 attribute can hold";
  EXPECT_EQ(variant.state_hashes.back(), "00000000000000ab");
  EXPECT_EQ(number_called(member_of(variant, 4999).numbers, "theta_c"), 5000.0);
}

TEST(ReadAverages, of_slopes_that_stand_has_no_angle_left) {
  MemberResult stands = member(1, 2.25);
  stands.numbers.numbers[0].value = none;
  const StoredVariant variant = written_and_read({stands});
  EXPECT_TRUE(variant.angles_left.empty());
  EXPECT_EQ(member_of(variant, 0).series.theta, (std::vector{0.0, 1.0, 2.0}));
}

/// Writes a file of one variant with two seeds and values of theta_c.
template <typename T>
void write_angles(const std::string& path, io::ElementType type, const char* shape,
                  const std::vector<T>& values) {
  io::hdf5::Writer file({}, io::seal_size);
  file.set_attribute("/variants/0", "name", "");
  file.set_attribute("/variants/0", "scenario", "");
  for (const char* name : {"/variants/0/seed", "/variants/0/state_hash"})
    file.write(io::DataSetField{name, io::ElementType::uint64, "2", "1", ""},
               std::vector<std::uint64_t>{1, 2});
  file.write(io::DataSetField{"/variants/0/numbers/theta_c/values", type, shape, "deg", ""}, values);
  std::vector<std::byte> bytes = file.image();
  io::seal(bytes, io::averages_seal);
  io::write_durably(path, bytes);
}

TEST(ReadAverages, refuses_other_files) {
  const test::TemporaryFolder folder;
  io::write_text(folder.path("text"), "talus run file 1\n");
  EXPECT_FALSE(holds_averages(folder.path("text")));
  EXPECT_FALSE(holds_averages(folder.path("none")));
  EXPECT_EQ(test::exit_code_of([&] { read_averages(folder.path("text")); }), ExitCode::bad_data);
  const std::string path = folder.path("made.h5");
  const std::vector<double> both = {19.0, 20.0};
  write_angles(path, io::ElementType::float64, "2 1", both);
  EXPECT_TRUE(holds_averages(path));
  EXPECT_EQ(read_averages(path).at(0).numbers.at(0).values, both);
  const auto code = [&path] { return test::exit_code_of([&] { read_averages(path); }); };
  write_angles(path, io::ElementType::float64, "1 1", std::vector<double>{19.0});
  EXPECT_EQ(code(), ExitCode::bad_data) << "a member without its number";
  write_angles(path, io::ElementType::uint64, "2 1", std::vector<std::uint64_t>{19, 20});
  EXPECT_EQ(code(), ExitCode::bad_data) << "numbers of another kind";
}

TEST(ReadAverages, refuses_an_infinite_value) {
  const test::TemporaryFolder folder;
  MemberResult broken = member(2, 4.5);
  broken.series.series[0].values[1] = std::numeric_limits<double>::infinity();
  write_averages(folder.path("e.h5"), {{"a", "seed = 1\n", averages_of({member(1, 2.5), broken}, 1.0)}},
                 "0.1.0");
  EXPECT_EQ(test::exit_code_of([&] { read_averages(folder.path("e.h5")); }), ExitCode::bad_data);
}

TEST(AnalysisOf, a_member_has_all_single_numbers_of_the_analysis_that_it_comes_from) {
  constexpr double diameter = 0.01;
  analysis::Analysis analysis = test::blank_analysis({.frames = 3, .thresholds = 2, .bins = 2});
  analysis.theta_c = radians(15.0);
  analysis.lc_cut = 40.0 * diameter;
  analysis.dilation = {radians(3.0), none};
  for (std::size_t f = 0; f < 2; ++f) {
    analysis.thresholds[f].factor = 1.0 + static_cast<double>(f);
    analysis.thresholds[f].lc_jump = radians(10.0 + static_cast<double>(f));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    analysis::FrameRecord& frame = analysis.frames[k];
    frame.tilt = radians(5.0 * static_cast<double>(k));
    frame.volume_strain = 0.001 * static_cast<double>(k);
    frame.critical_correlation_length = 3.0 * diameter;
    frame.thresholds[1].lc_mean = diameter * (4.0 + static_cast<double>(k));
    frame.thresholds[0].cluster_count = static_cast<Index>(7 + k);
  }
  MemberResult member{1, {"hash", "", 0.0, {}}, member_series(analysis, diameter)};
  for (const analysis::Quantity& quantity : analysis::quantities())
    if (analysis::is_number_of_run(quantity)) {
      const auto values = std::get<std::vector<double>>(analysis::values_of(quantity, analysis));
      for (std::size_t k = 0; k < values.size(); ++k)
        member.numbers.numbers.push_back({element_name(quantity.name, k),
                                          analysis::scaled_unit(quantity.unit),
                                          analysis::scaled(quantity.unit, values[k], diameter)});
    }
  const analysis::Analysis found = analysis_of(member, diameter);
  ASSERT_EQ(found.frames.size(), 3u);
  ASSERT_EQ(found.thresholds.size(), 2u);
  EXPECT_EQ(found.frames[0].thresholds[0].cluster_count, 7);
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    if (analysis::is_number_of_run(quantity)) {
      const auto before = std::get<std::vector<double>>(analysis::values_of(quantity, analysis));
      const auto after = std::get<std::vector<double>>(analysis::values_of(quantity, found));
      ASSERT_EQ(before.size(), after.size());
      for (std::size_t k = 0; k < before.size(); ++k)
        EXPECT_TRUE(std::isnan(before[k]) ? std::isnan(after[k]) : std::abs(after[k] - before[k]) < 1e-15)
            << quantity.name;
    }
    if (!analysis::is_number_of_frame(quantity)) continue;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t f = 0; f < 2; ++f) {
        const double before = analysis::number_of(quantity, analysis.frames[k], f);
        const double after = analysis::number_of(quantity, found.frames[k], f);
        EXPECT_TRUE(std::isnan(before) ? std::isnan(after) : std::abs(after - before) < 1e-15)
            << quantity.name << " " << before << " " << after;
      }
  }
}

}  // namespace
}  // namespace talus::ensemble
