/// Transitions before failure, and the distance to it. The last rise of a tilt, places in it, and ratios at
/// its end.

#include "analysis/failure/transition.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "analysis/failure/failure_distance.h"
#include "core/trigonometry.h"
#include "unit/analysis/packings.h"

namespace talus::analysis {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
const std::vector<double> tilts = {0.0, 0.1, 0.2, 0.4, 0.5, 0.6};

const std::vector<double> lengths = {5.0, 6.0, 5.5, 15.0, 16.0, 30.0};
constexpr double cut = 40.0;

TEST(LengthJump, is_the_largest_increase) {
  const LengthJump jump = length_jump(tilts, lengths, 0.55, cut);
  EXPECT_EQ(jump.tilt, 0.4) << "30 comes after theta_c";
  EXPECT_DOUBLE_EQ(jump.error, 0.2);
  EXPECT_DOUBLE_EQ(jump.size, 9.5);
  EXPECT_EQ(length_jump(tilts, lengths, none, cut).tilt, 0.6);
  EXPECT_EQ(length_jump(tilts, lengths, 0.6, cut).tilt, 0.6) << "theta_c counts";
}

TEST(LengthJump, ends_where_the_length_reaches_the_cut) {
  EXPECT_EQ(length_jump(tilts, lengths, none, 15.0).tilt, 0.4) << "30 comes after the first that is cut off";
  EXPECT_TRUE(std::isnan(length_jump(tilts, lengths, none, 5.0).tilt)) << "cut off from the start";
}

TEST(LengthJump, of_a_length_that_never_increases_is_none) {
  for (const auto& falling :
       {std::vector(6, 20.0), std::vector{9.0, 8.0, 7.0, 6.0, 5.0, 4.0}, std::vector(6, none)})
    EXPECT_TRUE(std::isnan(length_jump(tilts, falling, none, cut).tilt));
}

TEST(LengthJump, is_not_seen_beside_a_frame_without_overloaded_grains) {
  EXPECT_EQ(length_jump(tilts, std::vector{none, 20.0, none, 5.0, 6.0, 6.0}, none, cut).tilt, 0.5);
}

TEST(FirstSlide, is_where_the_layer_begins_to_move_far_enough_within_the_window) {
  const std::vector<double> displacements = {0.0, 0.1, 0.2, 0.6, 0.7, 2.0};
  EXPECT_EQ(first_slide(tilts, displacements, 0.5, 0.35), 0.1) << "0.5 from 0.1 to 0.4";
  EXPECT_EQ(first_slide(tilts, displacements, 0.5, 0.15), 0.5) << "1.3 from 0.5 to 0.6";
  EXPECT_EQ(first_slide(tilts, displacements, 0.5, 1.0), 0.0);
}

TEST(FirstSlide, of_a_layer_that_creeps_or_moves_upslope_is_none) {
  EXPECT_TRUE(std::isnan(first_slide(tilts, std::vector{0.0, 0.1, 0.2, 0.3, 0.4, 0.49}, 0.5, 0.6)));
  EXPECT_TRUE(std::isnan(first_slide(tilts, std::vector{9.0, 8.0, 7.0, 6.0, 5.0, 4.0}, 0.5, 0.6)));
  EXPECT_TRUE(std::isnan(first_slide({}, {}, 0.5, 0.6)));
}

TEST(PercolationOnset, is_the_first_of_three_frames) {
  const PercolationOnset onset = percolation_onset(tilts, std::vector<Index>{0, 1, 0, 1, 1, 1}, none);
  EXPECT_EQ(onset.tilt, 0.4);
  EXPECT_DOUBLE_EQ(onset.error, 0.2);
}

TEST(PercolationOnset, may_last_beyond_theta_c_but_not_begin_there) {
  EXPECT_EQ(percolation_onset(tilts, std::vector<Index>{0, 1, 0, 1, 1, 1}, 0.4).tilt, 0.4);
  EXPECT_TRUE(std::isnan(percolation_onset(tilts, std::vector<Index>{0, 1, 0, 1, 1, 1}, 0.39).tilt));
}

TEST(PercolationOnset, of_a_bed_that_spans_from_the_start_has_no_frame_before_it) {
  const PercolationOnset onset = percolation_onset(tilts, std::vector<Index>{1, 1, 1, 0, 0, 0}, none);
  EXPECT_EQ(onset.tilt, 0.0);
  EXPECT_TRUE(std::isnan(onset.error));
}

TEST(PercolationOnset, of_short_spells_is_none) {
  EXPECT_TRUE(std::isnan(percolation_onset(tilts, std::vector<Index>{1, 1, 0, 0, 1, 1}, none).tilt));
  EXPECT_TRUE(std::isnan(percolation_onset(std::vector{0.0}, std::vector<Index>{1}, none).tilt));
}

/// Strain over 0 ... 20 deg in rows of 0.01 deg, with alternating noise.
struct Strain {
  std::vector<double> tilt, value;
};
template <typename Law>
Strain strain_of(const Law& law, double noise) {
  Strain strain;
  for (int i = 0; i <= 2000; ++i) {
    strain.tilt.push_back(0.01 * i);
    strain.value.push_back(law(0.01 * i) + (i % 2 == 0 ? noise : -noise));
  }
  return strain;
}

TEST(DilationOnset, is_the_minimum_of_the_strain_within_its_noise) {
  const double noise = 1e-4;
  const Strain strain = strain_of([](double t) { return 1e-4 * (t - 15.0) * (t - 15.0); }, noise);
  const DilationOnset onset = dilation_onset(strain.tilt, strain.value, none, 1.0);
  EXPECT_NEAR(onset.tilt, 15.0, 0.05);
  EXPECT_NEAR(onset.low, 14.0, 0.06) << "the parabola exceeds its minimum there by the noise";
  EXPECT_NEAR(onset.high, 16.0, 0.06);
}

TEST(DilationOnset, of_a_strain_that_only_falls_is_none) {
  for (const double noise : {0.0, 1e-4}) {
    const Strain strain = strain_of([](double t) { return -1e-4 * t * t; }, noise);
    EXPECT_TRUE(std::isnan(dilation_onset(strain.tilt, strain.value, none, 1.0).tilt)) << noise;
  }
}

TEST(DilationOnset, of_a_strain_that_only_rises_is_the_start_within_its_noise) {
  const Strain strain = strain_of([](double t) { return 1e-4 * t * t; }, 1e-4);
  const DilationOnset onset = dilation_onset(strain.tilt, strain.value, none, 1.0);
  EXPECT_LT(onset.tilt, 0.5);
  EXPECT_EQ(onset.low, 0.0);
  EXPECT_NEAR(onset.high, 1.0, 0.1);
}

TEST(DilationOnset, looks_no_further_than_theta_c) {
  const Strain strain = strain_of([](double t) { return 1e-4 * (t - 15.0) * (t - 15.0); }, 1e-4);
  EXPECT_TRUE(std::isnan(dilation_onset(strain.tilt, strain.value, 14.9, 1.0).tilt));
  EXPECT_FALSE(std::isnan(dilation_onset(strain.tilt, strain.value, 17.0, 1.0).tilt));
  EXPECT_TRUE(std::isnan(dilation_onset({}, {}, none, 1.0).tilt));
}

TEST(GrowthExponent, of_a_power_law_is_its_power) {
  const std::vector<double> at = {0.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0, 21.0};
  std::vector<double> sizes;
  for (const double tilt : at) sizes.push_back(3.0 * std::pow(20.5 - tilt, -0.5));
  sizes[0] = 1e6;  // outside the window
  sizes[7] = 1e6;  // after theta_c
  sizes[3] = none;
  const GrowthExponent growth = growth_exponent(at, sizes, 20.5, 11.0);
  EXPECT_NEAR(growth.exponent, 0.5, 1e-12);
  EXPECT_NEAR(growth.error, 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(growth_exponent(at, sizes, 20.5, 9.0).exponent)) << "four are too few";
  EXPECT_TRUE(std::isnan(growth_exponent(at, sizes, none, 9.0).error));
}

// x = ln 1, ln 2, ln 4, ln 8, ln 16: in units of ln 2, -2 ... 2 about the middle, with a sum of squares of
// 10. Raising the middle point by ln 32 keeps the slope and gives residuals of 4 for it and -1 for the
// others: 20 / 3 / 10.
TEST(GrowthExponent, has_the_standard_error_of_a_slope) {
  const std::vector<double> at = {-16.0, -8.0, -4.0, -2.0, -1.0};
  const GrowthExponent growth = growth_exponent(at, std::vector<double>{1.0, 1.0, 32.0, 1.0, 1.0}, 0.0, 16.0);
  EXPECT_NEAR(growth.exponent, 0.0, 1e-12);
  EXPECT_NEAR(growth.error, std::sqrt(2.0 / 3.0), 1e-12);
}

using test::Packing;

/// Returns two layers, of heights up to 1 and up to 2: two grains on the floor, one above and between them,
/// and one without contacts. N = 3, M = 5.
Packing two_layers() {
  Packing packing = test::empty_packing(10.0, false);
  const Index left = test::add_grain(packing, 2.0, 0.5);
  const Index right = test::add_grain(packing, 3.0, 0.5);
  const Index top = test::add_grain(packing, 2.5, 0.5 + std::sqrt(0.75));
  test::add_grain(packing, 8.0, 0.5);
  const Index floor = test::add_floor_grain(packing, 2.0, -0.5);
  test::add_contact(packing, left, right, 1.0);
  test::add_contact(packing, left, top, 1.0, 0.5);  // critical, because the friction is 0.5
  test::add_contact(packing, right, top, 1.0);
  test::add_contact(packing, left, floor, 1.0, -0.5);
  test::add_contact(packing, right, floor + 1, 1.0);  // walls are numbered after all grains
  return packing;
}

// 2 M = 10 components of forces and 9 equations: 2 - 9/5 = 1/5 of the contacts may be critical.
TEST(FailureDistance, bound_is_where_unknown_forces_are_as_many_as_equations) {
  FrameRecord record;
  measure_failure_distance(two_layers(), 2.0, record);
  EXPECT_NEAR(record.critical_bound, 0.2, 1e-15);
  EXPECT_NEAR(record.critical_share_of_bound, 2.0, 1e-14);  // two are critical, so this is not an equilibrium
}

TEST(FailureDistance, of_contacts_that_resist_rolling_has_no_bound) {
  Packing packing = two_layers();
  packing.frame.contacts.moment.assign(static_cast<std::size_t>(packing.frame.contacts.count()), 0.0);
  FrameRecord record;
  measure_failure_distance(packing, 2.0, record);
  EXPECT_TRUE(std::isnan(record.critical_bound) && std::isnan(record.critical_share_of_bound));
  EXPECT_EQ(record.layer_critical_share.size(), 10u);
  for (const double share : record.layer_critical_share_of_bound) EXPECT_TRUE(std::isnan(share));
}

// 10 components minus 5 for the contacts, which are all critical, and 6 equations without those of torques.
TEST(FailureDistance, without_friction_has_no_torques_to_balance) {
  Packing packing = two_layers();
  packing.frame.friction = {};
  FrameRecord record;
  measure_failure_distance(packing, 2.0, record);
  EXPECT_NEAR(record.critical_bound, 2.0 - 6.0 / 5.0, 1e-15);
  packing.frame.friction.walls = 0.5;
  packing.frame.contacts.nx.back() = 0.0;  // with the floor
  measure_failure_distance(packing, 2.0, record);
  EXPECT_NEAR(record.critical_bound, 2.0 - 6.0 / 5.0, 1e-15);
  packing.frame.contacts.nx.back() = 1.0;  // with a wall
  measure_failure_distance(packing, 2.0, record);
  EXPECT_NEAR(record.critical_bound, 2.0 - 7.0 / 5.0, 1e-15) << "the torque on one grain";
}

// The lower layer contains the contact of its two grains, half of each contact with the top grain, and those
// with floor and wall.
TEST(FailureDistance, counts_of_layers_add_up) {
  const std::vector<ForceCount> counts = count_forces(two_layers(), 2.0, 2);
  EXPECT_EQ(counts[0].grains, 2.0);
  EXPECT_EQ(counts[0].contacts, 4.0);
  EXPECT_EQ(counts[0].critical, 1.5);
  EXPECT_EQ(counts[1].grains, 1.0);
  EXPECT_EQ(counts[1].contacts, 1.0);
  EXPECT_EQ(counts[1].critical, 0.5);
  EXPECT_EQ(counts[0].share(), 0.375);
  EXPECT_EQ(counts[0].share_of_bound(), 0.75);
  EXPECT_TRUE(std::isnan(counts[1].share_of_bound()));  // 2 - 3 gives no bound
}

TEST(FailureDistance, grains_above_the_height_belong_to_the_last_layer) {
  const std::vector<ForceCount> counts = count_forces(two_layers(), 1.0, 4);
  EXPECT_EQ(counts[1].grains, 0.0);
  EXPECT_EQ(counts[2].grains, 2.0);
  EXPECT_EQ(counts[3].grains, 1.0);
}

TEST(FailureDistance, of_a_bed_without_contacts_is_not_known) {
  Packing packing = test::empty_packing(10.0, true);
  test::add_grain(packing, 2.0, 0.5);
  FrameRecord record;
  measure_failure_distance(packing, 1.0, record);
  EXPECT_TRUE(std::isnan(record.critical_bound));
  EXPECT_TRUE(std::isnan(record.critical_share_of_bound));
  EXPECT_EQ(record.layer_critical_share.size(), 10u);
}

std::pair<std::size_t, std::size_t> rise(const std::vector<double>& tilts) {
  const SeriesPart part = last_rise(tilts);
  return {part.first, part.end};
}

using Part = std::pair<std::size_t, std::size_t>;

TEST(LastRise, is_all_of_what_never_falls_or_never_rises) {
  EXPECT_EQ(rise({}), Part(0, 0));
  EXPECT_EQ(rise({1}), Part(0, 1));
  EXPECT_EQ(rise({0, 1, 2, 3}), Part(0, 4));
  EXPECT_EQ(rise({0, 1, 1, 1, 3, 3}), Part(0, 6)) << "including its holds";
  EXPECT_EQ(rise({3, 2, 1}), Part(0, 3));
  EXPECT_EQ(rise({2, 2}), Part(0, 2));
}

TEST(LastRise, begins_where_the_tilt_was_lowest_and_ends_where_it_falls_again) {
  EXPECT_EQ(rise({0, 1, 2, 1, 0, 1, 2, 3}), Part(4, 8));
  EXPECT_EQ(rise({0, 1, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0}), Part(4, 9)) << "including the holds at both ends";
  EXPECT_EQ(rise({0, 2, 1}), Part(0, 2));
}

TEST(LastRise, goes_by_the_magnitude_of_the_tilt) {
  EXPECT_EQ(rise({0, 2, 1, 0, -1, -2, -3}), Part(3, 7));
  EXPECT_EQ(rise({0, -2, -0.5, 1, 2}), Part(2, 5)) << "from the tilt nearest to 0";
  EXPECT_EQ(magnitudes(std::vector<double>{0, -2, -0.5, 1, 2}, {2, 5}), (std::vector<double>{0.5, 1, 2}));
}

TEST(LastRise, of_rows_is_as_if_the_bed_were_tilted_to_one_side) {
  std::vector<ObservableRow> rows(5);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    at(rows[k], Observable::tilt) = std::vector{0.0, 0.2, 0.0, -0.1, -0.2}[k];
    at(rows[k], Observable::sigma_t_over_n) = at(rows[k], Observable::tilt);
    at(rows[k], Observable::surface_displacement) = -1.0 - static_cast<double>(k);
    at(rows[k], Observable::volume_strain) = -0.5;
  }
  const std::vector<ObservableRow> rise = rows_of_last_rise(rows);
  ASSERT_EQ(rise.size(), 3u);
  EXPECT_EQ(at(rise[2], Observable::tilt), 0.2);
  EXPECT_EQ(at(rise[2], Observable::sigma_t_over_n), 0.2);
  EXPECT_EQ(at(rise[2], Observable::surface_displacement), 5.0);
  EXPECT_EQ(at(rise[2], Observable::volume_strain), -0.5);
}

TEST(LastRise, of_frames_tells_them_and_their_tilts) {
  std::vector<FrameRecord> frames(4);
  for (std::size_t k = 0; k < 4; ++k) frames[k].tilt = std::vector{0.2, -0.1, -0.2, -0.1}[k];
  const FramesOfRise rise = last_rise(frames);
  EXPECT_EQ(rise.first, 1u);
  EXPECT_EQ(rise.tilts, (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(rise.frames, (std::vector<const FrameRecord*>{&frames[1], &frames[2]}));
  EXPECT_TRUE(rise.mirrored_slope);
  frames[3].tilt = 0.3;
  EXPECT_FALSE(last_rise(frames).mirrored_slope);
}

TEST(LastRise, of_a_bed_that_slopes_to_the_other_side_is_mirrored) {
  FrameRecord frame;
  frame.sigma_t_over_n = -0.25;
  frame.stress_ratio = 0.5;
  frame.texture_axis = -1.2;
  const auto number = [&frame](const QuantityMember& member, bool mirrored_slope) {
    return number_on_one_side(quantity_of(member), frame, 0, mirrored_slope);
  };
  EXPECT_EQ(number(&FrameRecord::sigma_t_over_n, false), -0.25);
  EXPECT_EQ(number(&FrameRecord::sigma_t_over_n, true), 0.25);
  EXPECT_EQ(number(&FrameRecord::stress_ratio, true), 0.5);
  EXPECT_EQ(number(&FrameRecord::texture_axis, false), -1.2);
  EXPECT_EQ(number(&FrameRecord::texture_axis, true), 1.2);
}

Analysis made_up() {
  Analysis analysis;
  analysis.theta_c = radians(16.0);
  analysis.thresholds.resize(2);
  analysis.thresholds[0].lc_jump = radians(10.0);
  analysis.thresholds[1].percolation = radians(5.0);
  for (int k = 0; k < 5; ++k) {
    FrameRecord& frame = analysis.frames.emplace_back();
    frame.tilt = radians(5.0 * k);
    frame.sigma_t_over_n = 0.1 * k;
    frame.thresholds.resize(2);
    for (int f = 0; f < 2; ++f)
      frame.thresholds[static_cast<std::size_t>(f)].overloaded_fraction = k + 0.1 * f;
  }
  return analysis;
}

double overloaded(const Analysis& analysis, Place place, std::size_t f = 0) {
  return number_at(analysis, {&FrameThreshold::overloaded_fraction, place}, f);
}

TEST(NumberOfRun, is_that_of_the_frame_at_its_place) {
  const Analysis analysis = made_up();
  EXPECT_EQ(overloaded(analysis, Place::start), 0.0);
  EXPECT_EQ(overloaded(analysis, Place::before_theta_d), 1.0);
  EXPECT_EQ(overloaded(analysis, Place::theta_d), 2.0);
  EXPECT_EQ(overloaded(analysis, Place::theta_c), 3.0) << "of 15 deg, not of 20";
  EXPECT_EQ(overloaded(analysis, Place::theta_c, 1), 3.1);
  EXPECT_EQ(overloaded(analysis, Place::percolation, 1), 1.1);
  EXPECT_EQ(number_at(analysis, {&RunThreshold::lc_jump, Place::run}), radians(10.0));
}

TEST(NumberOfRun, is_not_known_where_the_run_does_not_get_there) {
  Analysis analysis = made_up();
  EXPECT_TRUE(std::isnan(overloaded(analysis, Place::theta_d, 1))) << "no jump";
  EXPECT_TRUE(std::isnan(overloaded(analysis, Place::percolation, 0)));
  EXPECT_TRUE(std::isnan(overloaded(analysis, Place::theta_c, 2))) << "no third threshold";
  analysis.thresholds[0].lc_jump = 0.0;
  EXPECT_TRUE(std::isnan(overloaded(analysis, Place::before_theta_d))) << "no frame before the first";
  analysis.theta_c = not_known;
  EXPECT_TRUE(std::isnan(overloaded(analysis, Place::theta_c)));
  EXPECT_TRUE(std::isnan(overloaded(Analysis(), Place::start)));
}

TEST(NumberOfRun, is_of_the_last_rise_and_as_if_tilted_to_one_side) {
  Analysis analysis = made_up();
  for (int k = 0; k < 5; ++k) analysis.frames[static_cast<std::size_t>(k)].tilt *= -1.0;
  analysis.frames[0].tilt = radians(12.0);  // first the other way, then back to -5 deg and upwards
  EXPECT_EQ(overloaded(analysis, Place::start), 1.0);
  EXPECT_EQ(number_at(analysis, {&FrameRecord::sigma_t_over_n, Place::theta_c}), -0.1 * 3);
}

TEST(NumberOfRun, is_that_of_the_first_frame_of_a_hold) {
  Analysis analysis = made_up();
  analysis.frames[3].tilt = radians(10.0);
  EXPECT_EQ(overloaded(analysis, Place::theta_c), 2.0);
  EXPECT_EQ(overloaded(analysis, Place::theta_d), 2.0);
  EXPECT_EQ(overloaded(analysis, Place::before_theta_d), 1.0);
}

TEST(NumberOfRun, has_a_name_of_its_own) {
  std::set<std::string> names;
  for (const NumberOfRun& number : numbers_of_run()) {
    EXPECT_TRUE(names.insert(name_of(number)).second) << name_of(number);
    EXPECT_EQ(name_of(number).find('@') == std::string::npos, number.place == Place::run);
  }
  EXPECT_TRUE(names.contains("theta_c"));
  EXPECT_TRUE(names.contains("overloaded/fraction@theta_c"));
  EXPECT_TRUE(names.contains("lc/max@before_theta_d"));
}

TEST(FailureRatio, is_of_the_last_rows_before_it) {
  std::vector<double> tilts, stresses;
  for (const double ratio : {9.0, 9.0, 0.4, 0.6, 0.8, 9.0}) {
    tilts.push_back(radians(19.0 + 0.25 * static_cast<double>(tilts.size())));
    stresses.push_back(ratio * sine(tilts.back()) / cosine(tilts.back()));
  }
  const Statistics found = failure_ratio(tilts, stresses, radians(20.1), radians(0.75));
  EXPECT_NEAR(found.mean, 0.6, 1e-12) << "19.5, 19.75 and 20 deg";
  EXPECT_NEAR(found.deviation, 0.2, 1e-12);
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(failure_ratio(tilts, stresses, none, radians(0.75)).mean))
      << "the slope has not failed";
}

TEST(FailureRatio, leaves_out_the_horizontal_bed) {
  EXPECT_NEAR(failure_ratio(std::vector{0.0, 0.1}, std::vector{0.0, std::tan(0.1)}, 0.2, 1.0).mean, 1.0,
              1e-12);
}

}  // namespace
}  // namespace talus::analysis
