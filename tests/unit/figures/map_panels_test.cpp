#include <gtest/gtest.h>

#include <cmath>

#include "core/trigonometry.h"
#include "figures/recipes.h"

namespace talus::figures {
namespace {

/// Returns tilts from 0 to `last` degrees.
std::vector<double> tilts_every(double spacing, double last) {
  std::vector<double> tilts;
  for (int k = 0; k * spacing <= last; ++k) tilts.push_back(radians(k * spacing));
  return tilts;
}

std::vector<double> chosen(const std::vector<double>& tilts, double theta_c) {
  std::vector<double> angles;
  for (const std::size_t frame : panel_frames(tilts, radians(theta_c)))
    angles.push_back(std::round(1e6 * degrees(tilts[frame])) / 1e6);
  return angles;
}

TEST(PanelFrames, AreThePapersAngles) {
  EXPECT_EQ(chosen(tilts_every(0.25, 22.0), 20.6), (std::vector<double>{0, 5, 10, 15, 20.5}));
}

TEST(PanelFrames, LeaveOutWhatLiesBeyondFailure) {
  EXPECT_EQ(chosen(tilts_every(0.25, 14.0), 13.3), (std::vector<double>{0, 5, 10, 13.25}));
  EXPECT_EQ(chosen(tilts_every(0.25, 11.0), 10.0), (std::vector<double>{0, 5, 10})) << "the last is 10";
}

TEST(PanelFrames, NeverShowAFlow) {
  const std::vector<double> tilts = {0.0, radians(5.0), radians(10.0), radians(14.7), radians(15.2)};
  EXPECT_EQ(chosen(tilts, 15.1), (std::vector<double>{0, 5, 10, 14.7})) << "15.2 is nearer to 15";
}

TEST(PanelFrames, TakeTheFramesThatThereAre) {
  // A run whose frames begin late, such as that of a perturbed bed.
  std::vector<double> tilts;
  for (int k = 0; k <= 40; ++k) tilts.push_back(radians(7.0 + 0.25 * k));
  EXPECT_EQ(chosen(tilts, 16.3), (std::vector<double>{10, 15, 16.25}));
  EXPECT_EQ(chosen({radians(12.0)}, 12.1), (std::vector<double>{12}));
}

}  // namespace
}  // namespace talus::figures
