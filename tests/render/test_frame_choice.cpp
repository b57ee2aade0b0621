#include <gtest/gtest.h>

#include <limits>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "pictures/frame_choice.h"
#include "support/exit_code.h"

namespace talus::render {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Returns frames every 0.25 deg up to 17.25 deg, and one at which the slope failed.
std::vector<double> run_tilts() {
  std::vector<double> tilts;
  for (int k = 0; k <= 69; ++k) tilts.push_back(radians(0.25 * k));
  tilts.push_back(radians(17.253));
  return tilts;
}

TEST(FrameChoice, TakesTheNearestFrames) {
  const pictures::FrameChoice choice =
      pictures::frames_at(run_tilts(), {"5", "0", "10.1", "repose", "5.0"}, radians(16.9));
  EXPECT_EQ(choice, (pictures::FrameChoice{0, 20, 40, 67}));
  EXPECT_EQ(pictures::frames_at(run_tilts(), {"0.125"}, nan), pictures::FrameChoice{0});
}

TEST(FrameChoice, NearIsWithinHalfTheSpacing) {
  EXPECT_EQ(pictures::frame_near(run_tilts(), radians(5.1)), 20u);
  EXPECT_EQ(pictures::frame_near(run_tilts(), radians(17.37)), 70u);
  EXPECT_FALSE(pictures::frame_near(run_tilts(), radians(17.4)).has_value());
  EXPECT_FALSE(pictures::frame_near({radians(7.0), radians(7.5)}, 0.0).has_value());
}

TEST(FrameChoice, TheNearestIsByTilt) {
  EXPECT_EQ(pictures::nearest_frame({0.0, 1.0, 2.0}, 1.6), 2u);
  EXPECT_EQ(pictures::nearest_frame({0.0, 1.0, 2.0}, -3.0), 0u);
  EXPECT_FALSE(pictures::nearest_frame({0.0, 1.0}, std::nan("")).has_value());
  EXPECT_FALSE(pictures::nearest_frame({}, 1.0).has_value());
}

TEST(FrameChoice, RefusesWhatIsNotThere) {
  const auto code = [](const std::string& entry, double theta_c) {
    return test::exit_code_of([&] { pictures::frames_at(run_tilts(), {entry}, theta_c); });
  };
  EXPECT_EQ(code("17.3", nan), ExitCode::done);
  EXPECT_EQ(code("18", nan), ExitCode::bad_data);
  EXPECT_EQ(code("-1", nan), ExitCode::bad_data);
  EXPECT_EQ(code("repose", nan), ExitCode::bad_data);
  for (const char* entry : {"", "ten", "5deg", "nan", "inf", "1e999"})
    EXPECT_EQ(code(entry, nan), ExitCode::usage);
}

TEST(FrameChoice, TakesRangesOfFrames) {
  const std::vector<double> tilts(4, 0.0);  // and four frames of a flow
  EXPECT_EQ(pictures::frames_at(tilts, {"frame7", "frame2-frame4", "frame3"}, nan, 8),
            (pictures::FrameChoice{2, 3, 4, 7}));
  EXPECT_EQ(pictures::frames_at({0.0}, {"frame0-frame0"}, nan), pictures::FrameChoice{0});
  for (const char* entry : {"frame1-", "-frame1", "frame4-frame2", "frame1-2", "1-2", "frame1-frame2-frame3",
                            "frame1 - frame2", "frame99999999999999999999"})
    EXPECT_TRUE(test::refuses([&] { pictures::frames_at(tilts, {entry}, nan, 8); }, ExitCode::usage))
        << entry;
  EXPECT_EQ(
      test::refusal_of([&] { pictures::frames_at(tilts, {"frame6-frame8"}, nan, 8); }),
      (test::Refusal{ExitCode::bad_data, "--at frame6-frame8: the run has 8 frames, frame0 to frame7"}));
  EXPECT_EQ(pictures::single_frame({3}, "frame3-frame3"), 3u);
  EXPECT_EQ(test::refusal_of([&] {
              pictures::single_frame({3, 4}, "frame3-frame4");
            }),
            (test::Refusal{ExitCode::usage, "--at frame3-frame4: expected one frame, found 2"}));
}

TEST(FrameChoice, ReposeIsTheLastFrameNotAboveThetaC) {
  EXPECT_EQ(pictures::frame_at_repose(run_tilts(), radians(17.0)), 68u);
  EXPECT_EQ(pictures::frame_at_repose(run_tilts(), radians(17.24)), 68u);
  EXPECT_EQ(pictures::frame_at_repose(run_tilts(), radians(60.0)), 70u);
}

TEST(FrameChoice, TakesOneFrameEveryStep) {
  const pictures::FrameChoice choice = pictures::frames_every(run_tilts(), 1.0);
  ASSERT_EQ(choice.size(), 18u);
  for (std::size_t k = 0; k < choice.size(); ++k) EXPECT_EQ(choice[k], 4 * k);
  EXPECT_EQ(pictures::frames_every(run_tilts(), 0.25).size(), 70u);
  EXPECT_EQ(pictures::frames_every(run_tilts(), 0.0).size(), 71u);
  EXPECT_EQ(pictures::frames_every({0.0}, 1.0), pictures::FrameChoice{0});
}

TEST(FrameChoice, NamesSortAndTellFramesApart) {
  const std::vector<double> tilts = run_tilts();
  EXPECT_EQ(pictures::angle_decimals(tilts, {0, 48}), 2);
  EXPECT_EQ(pictures::angle_name(tilts[48], 2), "012.00");
  EXPECT_EQ(pictures::angle_decimals(tilts, {69, 70}), 3);
  EXPECT_EQ(pictures::angle_name(tilts[70], 3), "017.253");
  EXPECT_EQ(pictures::angle_decimals(tilts, {69, 71, 72}), 2) << "frames of a flow have different names";
  EXPECT_THROW(pictures::angle_decimals({0.1, 0.1}, {0, 1}), Error);
}

/// Returns tilts up to 2 deg, held, down to -1 deg, and up to 3 deg, by 0.5 deg per frame.
std::vector<double> cycled_tilts() {
  std::vector<double> tilts;
  for (const double tilt : {0.0,  0.5,  1.0,  1.5, 2.0, 2.0, 2.0, 1.5, 1.0, 0.5, 0.0,
                            -0.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0})
    tilts.push_back(radians(tilt));
  return tilts;
}

TEST(FrameChoice, WhereTheTiltGoesUpAndDownTheFirstFrameAtAnAngleCounts) {
  EXPECT_EQ(pictures::frames_at(cycled_tilts(), {"1"}, nan), pictures::FrameChoice{2});
  EXPECT_EQ(pictures::frames_at(cycled_tilts(), {"2"}, nan), pictures::FrameChoice{4})
      << "beginning of the hold";
  EXPECT_EQ(pictures::frames_at(cycled_tilts(), {"-0.9"}, nan), pictures::FrameChoice{12});
  EXPECT_EQ(pictures::frames_at(cycled_tilts(), {"3"}, nan), pictures::FrameChoice{20});
  EXPECT_EQ(pictures::frames_at(cycled_tilts(), {"0.7"}, nan), pictures::FrameChoice{1});
  EXPECT_FALSE(pictures::frame_near(cycled_tilts(), radians(3.3)).has_value());
}

TEST(FrameChoice, AFrameMayBeTakenByItsNumber) {
  EXPECT_EQ(pictures::frames_at(cycled_tilts(), {"frame16", "1", "frame0"}, nan),
            (pictures::FrameChoice{0, 2, 16}));
  for (const char* entry : {"frame", "frame-1", "frame1.5", "Frame1", "frame 1"})
    EXPECT_TRUE(test::refuses([&] { pictures::frames_at(cycled_tilts(), {entry}, nan); }, ExitCode::usage))
        << entry;
  EXPECT_EQ(test::refusal_of([&] { pictures::frames_at(cycled_tilts(), {"frame21"}, nan); }),
            (test::Refusal{ExitCode::bad_data,
                           "--at frame21: the tilt of the run has 21 frames, frame0 to frame20"}));
}

TEST(FrameChoice, ReposeIsInTheLastRise) {
  EXPECT_EQ(pictures::frame_at_repose(cycled_tilts(), radians(1.6)), 17u);
  EXPECT_EQ(pictures::frame_at_repose(cycled_tilts(), radians(2.0)), 18u);
  EXPECT_EQ(pictures::frame_at_repose(cycled_tilts(), radians(9.0)), 20u);
  std::vector<double> mirrored = cycled_tilts();
  for (double& tilt : mirrored) tilt = -tilt;
  EXPECT_EQ(pictures::frame_at_repose(mirrored, radians(1.6)), 17u) << "compared by magnitude";
}

TEST(FrameChoice, TakesOneFrameEveryStepOfEachWay) {
  EXPECT_EQ(pictures::frames_every(cycled_tilts(), 1.0),
            (pictures::FrameChoice{0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20}))
      << "and at the turns of the tilt";
  EXPECT_EQ(pictures::frames_every(cycled_tilts(), 0.1).size(), 21u);
}

TEST(FrameChoice, MotionIsMeasuredFromAnEarlierFrame) {
  EXPECT_EQ(pictures::reference_frame(3, {}), 2u);
  EXPECT_EQ(pictures::reference_frame(3, 1), 1u);
  EXPECT_FALSE(pictures::reference_frame(0, {}).has_value());
  EXPECT_FALSE(pictures::reference_frame(1, 1).has_value()) << "motion is measured from this frame";
  EXPECT_FALSE(pictures::reference_frame(0, 1).has_value());
}

}  // namespace
}  // namespace talus::render
