#include "view/run_clock.h"

#include <gtest/gtest.h>

namespace talus::view {
namespace {

/// Returns frames at 0, 1, 2, 3 rad, one per second from 10 s on, and two of a flow at 13.5 and 14 s.
RunInstants failed(double theta_c) {
  return {{0.0, 1.0, 2.0, 3.0, 3.0, 3.0}, {10.0, 11.0, 12.0, 13.0, 13.5, 14.0}, 4, theta_c};
}

/// Returns a run that tilts half as fast, from 20 s on, without a flow.
RunInstants unfailed() { return {{0.0, 0.5, 1.0, 1.5, 2.0}, {20.0, 21.0, 22.0, 23.0, 24.0}, 5, not_known}; }

TEST(LinkedFrame, ByTheTilt) {
  EXPECT_EQ(linked_frame(PlotAxis::tilt, failed(3.2), {1.4, 11.4, false}, unfailed()), 3u);
  EXPECT_EQ(linked_frame(PlotAxis::tilt, unfailed(), {1.5, 23.0, false}, failed(3.2)), 1u)
      << "the first of two";
  EXPECT_EQ(linked_frame(PlotAxis::tilt, failed(3.2), {3.0, 13.0, false}, unfailed()), 4u)
      << "limited to the range of its frames";
}

TEST(LinkedFrame, ByTheAngleLeft) {
  EXPECT_EQ(linked_frame(PlotAxis::angle_left, failed(3.0), {1.0, 11.0, false}, failed(4.1)), 2u);
  EXPECT_EQ(linked_frame(PlotAxis::angle_left, failed(3.0), {1.0, 11.0, false}, unfailed()), std::nullopt);
  EXPECT_EQ(linked_frame(PlotAxis::angle_left, failed(3.0), {-1.0, 11.0, false}, failed(4.1)), 2u)
      << "whichever way the bed slopes";
}

TEST(LinkedFrame, ByTheTimeSinceTheFirstFrame) {
  EXPECT_EQ(linked_frame(PlotAxis::time, unfailed(), {1.0, 22.0, false}, failed(3.2)), 2u);
  EXPECT_EQ(linked_frame(PlotAxis::time, unfailed(), {2.0, 24.0, false}, failed(3.2)), 5u)
      << "also into the flow";
}

TEST(LinkedFrame, OfAFlowIsInTheFlow) {
  EXPECT_EQ(linked_frame(PlotAxis::tilt, failed(3.2), {3.0, 13.6, true}, failed(3.2)), 4u);
  EXPECT_EQ(linked_frame(PlotAxis::tilt, failed(3.2), {3.0, 13.9, true}, failed(3.2)), 5u);
  EXPECT_EQ(linked_frame(PlotAxis::tilt, failed(3.2), {1.0, 13.9, true}, unfailed()), 2u)
      << "if it has a flow";
}

TEST(LinkedFrame, IsNoneWhereThereAreNoFrames) {
  EXPECT_EQ(linked_frame(PlotAxis::tilt, unfailed(), {1.0, 22.0, false}, {}), std::nullopt);
}

}  // namespace
}  // namespace talus::view
