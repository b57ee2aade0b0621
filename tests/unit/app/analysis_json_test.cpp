/// The analysis of a run as JSON: all that its table has, under the names of the table.

#include <gtest/gtest.h>

#include "app/analysis_report.h"
#include "support/blank_analysis.h"

namespace talus {
namespace {

TEST(AnalysisJson, has_each_quantity_of_its_table) {
  AnalysedRun run;
  run.analysis = test::blank_analysis({.frames = 2, .thresholds = 1, .grains = 3, .sections = 2, .bins = 2});
  run.analysis.frames[1].volume = 0.25;
  std::vector<Quantity> table = quantities();
  table.push_back({&FrameRecord::volume, "packing/made_up", "T", "m", "made up for this test", ""});
  const std::string text = analysis_json(run, table);
  EXPECT_NE(text.find("\"packing/made_up\": [null, 0.25]"), std::string::npos) << text;
  EXPECT_EQ(analysis_json(run).find("made_up"), std::string::npos);
  EXPECT_EQ(text.find("lc/length"), std::string::npos) << "values of single grains are left out";
}

}  // namespace
}  // namespace talus
