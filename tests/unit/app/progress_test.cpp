/// Reports of commands: progress, unconverged steps, analyses.

#include "app/progress.h"

#include <gtest/gtest.h>

#include <sstream>

#include "app/analysis_report.h"
#include "core/trigonometry.h"
#include "runs/analysis_parameters.h"
#include "session/estimate.h"
#include "support/blank_analysis.h"
#include "support/has.h"

namespace talus::app {
namespace {

using test::has;

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

session::SolverRecord record_of(std::int64_t tilt) {
  session::SolverRecord record;
  record.unconverged_tilt = tilt;
  record.residual_max_rest = 6.6e-6;
  record.residual_max_moving = 2.1e-4;
  return record;
}

TEST(UnconvergedSteps, AreStatedWhereTheyAreFew) {
  const StepRemark remark = remark_on(record_of(16), 18041);
  EXPECT_TRUE(remark.usual);
  EXPECT_EQ(
      remark.text,
      "0.089 % of the steps did not reach their tolerance (largest residual in the tilt 6.6e-06 at rest, "
      "0.00021 while moving); this is usual (docs/solver.md).");
}

TEST(UnconvergedSteps, AreAWarningWhereTheyAreMany) {
  EXPECT_TRUE(remark_on(record_of(20), 10000).usual);
  const StepRemark remark = remark_on(record_of(21), 10000);
  EXPECT_FALSE(remark.usual);
  EXPECT_TRUE(test::has_all(remark.text, {"0 in the deposition, 21 in the tilt, 0 after failure",
                                          "up to 0.2 % is usual", "solver.max_iterations"}));
}

TEST(UnconvergedSteps, AreNotMentionedWhereThereAreNone) {
  EXPECT_EQ(remark_on(record_of(0), 1000).text, "");
  EXPECT_EQ(remark_on(session::SolverRecord(), 0).text, "");
}

TEST(AnalysisJson, has_each_quantity_of_its_table) {
  runs::RunView run;
  run.analysis = test::blank_analysis({.frames = 2, .thresholds = 1, .grains = 3, .sections = 2, .bins = 2});
  run.analysis.frames[1].volume = 0.25;
  std::vector<analysis::Quantity> table = analysis::quantities();
  table.push_back({&analysis::FrameRecord::volume, "packing/made_up", "T", "m", "made up for this test", ""});
  const std::string text = analysis_json(run, table);
  EXPECT_TRUE(test::has(text, "\"packing/made_up\": [null, 0.25]"));
  EXPECT_FALSE(test::has(analysis_json(run), "made_up"));
  EXPECT_FALSE(test::has(text, "lc/length")) << "values of single grains are omitted";
}

runs::RunView run_of(const test::AnalysisSizes& sizes) {
  runs::RunView run;
  run.statics.mean_diameter = 1.0;
  run.analysis = test::blank_analysis(sizes);
  run.analysis.parameters = runs::as_facts(analysis::AnalysisParameters());
  return run;
}

TEST(AnalysisText, has_rows_at_round_angles_at_repose_and_after_failure) {
  runs::RunView run = run_of({.frames = 25, .thresholds = 2, .sections = 2, .bins = 2});
  run.analysis.theta_c = radians(15.9);
  run.analysis.thresholds[1] = {.factor = 2.0, .gamma = 1.25};
  for (std::size_t k = 0; k < 25; ++k) {
    run.analysis.frames[k].tilt = radians(0.7 * static_cast<double>(k));
    run.analysis.frames[k].thresholds[0].overloaded_fraction = 0.25;
    run.analysis.frames[k].thresholds[1].overloaded_fraction = 0.0;
  }
  const std::string text = analysis_text(run);
  std::string rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.find("0.250") != std::string::npos)
      rows += line.substr(line.find_first_not_of(' '), line.find(' ', 2) - line.find_first_not_of(' ')) +
              (line.ends_with("at repose")       ? " r"
               : line.ends_with("after failure") ? " f"
                                                 : "") +
              "\n";
  EXPECT_EQ(rows, "0.00\n2.10\n4.20\n6.30\n7.70\n9.80\n11.90\n14.00\n15.40 r\n16.10 f\n16.80 f\n") << text;
  EXPECT_NE(text.find("no grain reaches 2 Gamma_c = 1.2500; gamma under compression is at most 1"),
            std::string::npos)
      << text;
}

TEST(AnalysisText, says_that_a_fast_tilt_went_on_while_the_flow_gathered_speed) {
  const auto text_with = [](double theta_c, double first_slide) {
    runs::RunView run = run_of({.frames = 2, .sections = 2, .bins = 2});
    run.analysis.frames[0].tilt = 0.0;
    run.analysis.frames[1].tilt = 0.4;
    run.analysis.theta_c = theta_c;
    run.analysis.first_slide = first_slide;
    return analysis_text(run);
  };
  EXPECT_TRUE(test::has(text_with(0.3, 0.4), "22.92 deg, after theta_c: tilting continued while the flow"));
  EXPECT_FALSE(test::has(text_with(0.3, 0.29), "after theta_c"));
  EXPECT_FALSE(test::has(text_with(not_known, 0.29), "after theta_c"));
}

TEST(AnalysisText, names_the_beginning_of_the_last_rise_with_its_sign) {
  runs::RunView run = run_of({.frames = 3, .sections = 2, .bins = 2});
  run.analysis.frames[0].tilt = 0.2;
  run.analysis.frames[1].tilt = -0.1;
  run.analysis.frames[2].tilt = 0.4;
  EXPECT_TRUE(test::has(analysis_text(run), "the last rise, from -5.73 deg"));
}

TEST(BeyondRepose, is_told_from_a_degree_on) {
  EXPECT_EQ(beyond_repose(0.3, 0.31), "");
  EXPECT_EQ(beyond_repose(0.3, 0.2), "");
  EXPECT_TRUE(beyond_repose(0.3, 0.4).starts_with("; tilting continued to 22.92 deg while this flow"));
}

}  // namespace
}  // namespace talus::app
