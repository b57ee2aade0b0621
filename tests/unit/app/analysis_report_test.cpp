/// Analysis of a run as text and as JSON, with everything in its table under the names of the table.

#include "app/analysis_report.h"

#include <gtest/gtest.h>

#include "runs/analysis_parameters.h"
#include "support/blank_analysis.h"

namespace talus::app {
namespace {

TEST(AnalysisJson, has_each_quantity_of_its_table) {
  runs::RunView run;
  run.analysis = test::blank_analysis({.frames = 2, .thresholds = 1, .grains = 3, .sections = 2, .bins = 2});
  run.analysis.frames[1].volume = 0.25;
  std::vector<analysis::Quantity> table = analysis::quantities();
  table.push_back({&analysis::FrameRecord::volume, "packing/made_up", "T", "m", "made up for this test", ""});
  const std::string text = analysis_json(run, table);
  EXPECT_NE(text.find("\"packing/made_up\": [null, 0.25]"), std::string::npos) << text;
  EXPECT_EQ(analysis_json(run).find("made_up"), std::string::npos);
  EXPECT_EQ(text.find("lc/length"), std::string::npos) << "values of single grains are omitted";
}

TEST(AnalysisText, says_that_a_fast_tilt_went_on_while_the_flow_gathered_speed) {
  const auto text_with = [](double theta_c, double first_slide) {
    runs::RunView run;
    run.statics.mean_diameter = 1.0;
    run.analysis = test::blank_analysis({.frames = 2, .sections = 2, .bins = 2});
    run.analysis.parameters = runs::as_facts(analysis::AnalysisParameters());
    run.analysis.frames[0].tilt = 0.0;
    run.analysis.frames[1].tilt = 0.4;
    run.analysis.theta_c = theta_c;
    run.analysis.first_slide = first_slide;
    return analysis_text(run);
  };
  EXPECT_NE(text_with(0.3, 0.4).find("22.92 deg, after theta_c: tilting continued while the flow"),
            std::string::npos);
  EXPECT_EQ(text_with(0.3, 0.29).find("after theta_c"), std::string::npos);
  EXPECT_EQ(text_with(not_known, 0.29).find("after theta_c"), std::string::npos);
}

TEST(AnalysisText, names_the_beginning_of_the_last_rise_with_its_sign) {
  runs::RunView run;
  run.statics.mean_diameter = 1.0;
  run.analysis = test::blank_analysis({.frames = 3, .sections = 2, .bins = 2});
  run.analysis.parameters = runs::as_facts(analysis::AnalysisParameters());
  run.analysis.frames[0].tilt = 0.2;
  run.analysis.frames[1].tilt = -0.1;
  run.analysis.frames[2].tilt = 0.4;
  EXPECT_NE(analysis_text(run).find("the last rise, from -5.73 deg"), std::string::npos);
}

TEST(BeyondRepose, is_told_from_a_degree_on) {
  EXPECT_EQ(beyond_repose(0.3, 0.31), "");
  EXPECT_EQ(beyond_repose(0.3, 0.2), "");
  EXPECT_TRUE(beyond_repose(0.3, 0.4).starts_with("; tilting continued to 22.92 deg while this flow"));
}

}  // namespace
}  // namespace talus::app
