/// Progress lines fit the terminal and keep the most important parts.

#include "app/progress.h"

#include <gtest/gtest.h>

#include "session/estimate.h"

namespace talus::app {
namespace {

bool has(const std::string& line, const std::string& part) { return line.find(part) != std::string::npos; }

RunDisplay tilting() {
  RunDisplay shown;
  shown.phase = session::Phase::tilt;
  shown.tilt = 12.345;
  shown.share = 12.345 / 20.0;
  shown.repose_assumed = 20.0;
  shown.residual = 2.9e-7;
  shown.kinetic_energy = 1.2e-12;
  shown.velocity = 1.23e-3;
  return shown;
}

std::string run_text(const RunDisplay& shown, std::optional<int> width) {
  return progress_text(run_progress(shown, 3725.0, 11000.0), width);
}

std::string count_text(std::size_t done, double elapsed, std::optional<int> width) {
  return progress_text(count_progress("rendering", done, 48, elapsed), width);
}

TEST(Durations, AreTextsOfTwoUnitsAtMost) {
  EXPECT_EQ(session::duration_text(7.6), "8 s");
  EXPECT_EQ(session::duration_text(125.0), "2 min 05 s");
  EXPECT_EQ(session::duration_text(11400.0), "3 h 10 min");
}

TEST(ProgressText, FitsEveryWidth) {
  RunDisplay shown = tilting();
  for (const session::Phase phase :
       {session::Phase::deposition, session::Phase::tilt, session::Phase::flow}) {
    shown.phase = phase;
    for (int width = 0; width <= 250; ++width)
      EXPECT_LE(run_text(shown, width).size(), static_cast<std::size_t>(width));
  }
}

TEST(ProgressText, KeepsWhatMattersMost) {
  const auto line = [](int width) { return run_text(tilting(), width); };
  EXPECT_EQ(line(60), "tilt 12.345 deg  61 %  elapsed 1 h 02 min  ETA 3 h 03 min");
  EXPECT_EQ(line(79), "tilt 12.345 deg  [########------]  61 %  elapsed 1 h 02 min  ETA 3 h 03 min");
  EXPECT_EQ(line(109),
            "tilt 12.345 deg  [########------]  61 %  elapsed 1 h 02 min  ETA 3 h 03 min  residual 2.9e-07");
  EXPECT_EQ(line(200),
            "tilt 12.345 deg  [########------]  61 %  elapsed 1 h 02 min  ETA 3 h 03 min  "
            "if it fails at 20 deg  residual 2.9e-07  E_kin 1.2e-12 J  v = 1.23e-03 g h");
  EXPECT_EQ(line(10), "tilt 12.34");
}

TEST(ProgressText, OfALogHasAllButTheBar) {
  EXPECT_EQ(run_text(tilting(), std::nullopt),
            "tilt 12.345 deg  61 %  elapsed 1 h 02 min  ETA 3 h 03 min  if it fails at 20 deg  "
            "residual 2.9e-07  E_kin 1.2e-12 J  v = 1.23e-03 g h");
}

TEST(ProgressText, PromisesNothingBeyondTheExpectedEnd) {
  RunDisplay shown = tilting();
  shown.share = 1.05;
  const std::string line = run_text(shown, 200);
  EXPECT_FALSE(has(line, "%") || has(line, "ETA") || has(line, "[")) << line;
}

TEST(ProgressText, OfOtherStages) {
  RunDisplay shown = tilting();
  shown.repose_assumed.reset();
  shown.phase = session::Phase::deposition;
  shown.time = 0.25;
  shown.contacts = 2000;
  EXPECT_EQ(run_text(shown, 79),
            "deposition 0.250 s  [########------]  61 %  elapsed 1 h 02 min  ETA 3 h 03 min");
  shown.phase = session::Phase::flow;
  shown.share.reset();
  EXPECT_EQ(run_text(shown, 60), "flow at 12.345 deg  elapsed 1 h 02 min  residual 2.9e-07");
}

TEST(ProgressText, OfThingsThatAreCounted) {
  EXPECT_EQ(count_text(0, 1.0, 79), "rendering 0/48  [--------------]  0 %  elapsed 1 s");
  EXPECT_EQ(count_text(12, 10.0, 79), "rendering 12/48  [###-----------]  25 %  elapsed 10 s  ETA 30 s");
  EXPECT_EQ(count_text(48, 40.0, std::nullopt), "rendering 48/48  100 %  elapsed 40 s");
}

TEST(ProgressBar, IsFullAtTheEnd) {
  const auto line = [](double share) { return progress_text({"a", share, 1.0, {}}, 79); };
  EXPECT_EQ(line(0.0), "a  [--------------]  0 %  elapsed 1 s");
  EXPECT_EQ(line(0.5), "a  [#######-------]  50 %  elapsed 1 s");
  EXPECT_EQ(line(1.0), "a  [##############]  100 %  elapsed 1 s");
  EXPECT_EQ(line(7.0), "a  elapsed 1 s") << "beyond the estimate";
}

}  // namespace
}  // namespace talus::app
