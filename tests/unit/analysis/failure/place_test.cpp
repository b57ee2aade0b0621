/// Values of a run at places, from a hand-made analysis of five frames, 5 deg apart.

#include "analysis/failure/place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/trigonometry.h"

namespace talus::analysis {
namespace {

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

}  // namespace
}  // namespace talus::analysis
