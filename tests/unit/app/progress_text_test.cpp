/// Lines of progress fit the terminal, and keep what matters most.

#include "app/progress_text.h"

#include <gtest/gtest.h>

namespace talus {
namespace {

bool has(const std::string& line, const std::string& part) { return line.find(part) != std::string::npos; }

RunShown tilting() {
  RunShown shown;
  shown.stage = RunShown::Stage::tilt;
  shown.tilt = 12.345;
  shown.tilt_end = 20.0;
  shown.end_expected = true;
  shown.remaining = 11000.0;
  shown.residual = 2.9e-7;
  shown.kinetic_energy = 1.2e-12;
  shown.velocity = 1.23e-3;
  shown.seconds = 3725.0;
  return shown;
}

TEST(Durations, AreTextsOfTwoUnitsAtMost) {
  EXPECT_EQ(duration_text(7.6), "8 s");
  EXPECT_EQ(duration_text(125.0), "2 min 05 s");
  EXPECT_EQ(duration_text(11400.0), "3 h 10 min");
}

TEST(ProgressText, FitsEveryWidth) {
  RunShown shown = tilting();
  for (const RunShown::Stage stage :
       {RunShown::Stage::deposition, RunShown::Stage::tilt, RunShown::Stage::flow}) {
    shown.stage = stage;
    for (int width = 0; width <= 250; ++width)
      EXPECT_LE(run_progress_text(shown, width).size(), static_cast<std::size_t>(width));
  }
}

TEST(ProgressText, KeepsWhatMattersMost) {
  const auto line = [](int width) { return run_progress_text(tilting(), width); };
  EXPECT_EQ(line(60), "tilt 12.345 deg  61 %  ETA 3 h 03 min  (1 h 02 min)");
  EXPECT_EQ(line(80), "tilt 12.345 deg  [############--------]  61 %  ETA 3 h 03 min  (1 h 02 min)");
  EXPECT_EQ(line(110),
            "tilt 12.345 deg  [############--------]  61 %  ETA 3 h 03 min  (1 h 02 min)  residual 2.9e-07");
  EXPECT_EQ(line(200),
            "tilt 12.345 deg  [############--------]  61 %  ETA 3 h 03 min  if it fails at 20 deg  "
            "(1 h 02 min)  residual 2.9e-07  E_kin 1.2e-12 J  v = 1.23e-03 g h");
  EXPECT_EQ(line(10), "tilt 12.34");
}

TEST(ProgressText, OfALogHasAllButTheBar) {
  EXPECT_EQ(run_progress_text(tilting(), std::nullopt),
            "tilt 12.345 deg  61 %  ETA 3 h 03 min  if it fails at 20 deg  (1 h 02 min)  residual 2.9e-07  "
            "E_kin 1.2e-12 J  v = 1.23e-03 g h");
}

TEST(ProgressText, PromisesNothingBeyondTheExpectedEnd) {
  RunShown shown = tilting();
  shown.tilt = 21.0;
  const std::string line = run_progress_text(shown, 200);
  EXPECT_FALSE(has(line, "%") || has(line, "ETA") || has(line, "[")) << line;
}

TEST(ProgressText, OfOtherPhasesHasNoShare) {
  RunShown shown = tilting();
  shown.stage = RunShown::Stage::deposition;
  shown.time = 0.25;
  shown.contacts = 2000;
  EXPECT_EQ(run_progress_text(shown, 120),
            "deposition  t = 0.250 s  (1 h 02 min)  residual 2.9e-07  contacts 2000  v = 1.23e-03 g h");
  shown.stage = RunShown::Stage::flow;
  EXPECT_TRUE(run_progress_text(shown, 120).starts_with("flow at 12.345 deg  (1 h 02 min)  residual"));
}

TEST(ProgressBar, IsFullAtTheEnd) {
  EXPECT_EQ(progress_bar(0.0), "[--------------------]");
  EXPECT_EQ(progress_bar(0.5), "[##########----------]");
  EXPECT_EQ(progress_bar(1.0), "[####################]");
  EXPECT_EQ(progress_bar(7.0), progress_bar(1.0));
}

}  // namespace
}  // namespace talus
