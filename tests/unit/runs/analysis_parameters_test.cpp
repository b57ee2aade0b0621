/// Parameters of an analysis: accepted and rejected values, and their table in the documentation.

#include "runs/analysis_parameters.h"

#include <gtest/gtest.h>

#include "base/errors.h"
#include "scenario/text.h"
#include "support/key_rows.h"

namespace talus::runs {
namespace {

std::string refusal(const std::vector<std::string>& settings) {
  try {
    parse_analysis_settings(settings);
  } catch (const LocatedError& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    return error.what();
  }
  return "accepted";
}

TEST(AnalysisParameters, are_taken_from_settings) {
  const analysis::AnalysisParameters p = parse_analysis_settings(
      {"threshold_factors=0.5,1,3", "gamma_c=0.3", "l_min=0", "lc_factor=2", "lc_cut=30",
       "joining=neighbours", "averaging=0.5", "min_contacts=3", "sections=7", "bins=10",
       "event_velocity=0.02", "event_quiet=2", "event_displacement=0.05", "event_size_min=0.1"});
  EXPECT_EQ(p.threshold_factors, (std::vector{0.5, 1.0, 3.0}));
  EXPECT_EQ(p.gamma_c, 0.3);
  EXPECT_EQ(p.l_min, 0.0);
  EXPECT_EQ(p.lc_factor, 2.0);
  EXPECT_EQ(p.lc_cut, 30.0);
  EXPECT_EQ(p.joining, analysis::Joining::neighbours);
  EXPECT_EQ(p.averaging, 0.5);
  EXPECT_EQ(p.min_contacts, 3);
  EXPECT_EQ(p.sections, 7);
  EXPECT_EQ(p.bins, 10);
  EXPECT_EQ(p.event_velocity, 0.02);
  EXPECT_EQ(p.event_quiet, 2.0);
  EXPECT_EQ(p.event_displacement, 0.05);
  EXPECT_EQ(p.event_size_min, 0.1);
  EXPECT_EQ(as_facts(p), (Facts{{"threshold_factors", "0.5,1,3"},
                                {"gamma_c", "0.3"},
                                {"l_min", "0"},
                                {"lc_factor", "2"},
                                {"lc_cut", "30"},
                                {"joining", "neighbours"},
                                {"averaging", "0.5"},
                                {"min_contacts", "3"},
                                {"sections", "7"},
                                {"bins", "10"},
                                {"event_velocity", "0.02"},
                                {"event_quiet", "2"},
                                {"event_displacement", "0.05"},
                                {"event_size_min", "0.1"}}));
}

TEST(AnalysisParameters, admit_their_defaults_as_text) {
  EXPECT_EQ(as_facts(from_facts(as_facts(analysis::AnalysisParameters{}))),
            as_facts(analysis::AnalysisParameters{}));
  EXPECT_FALSE(parse_analysis_settings({"gamma_c=run"}).gamma_c.has_value());
  EXPECT_FALSE(parse_analysis_settings({"event_velocity=solver"}).event_velocity.has_value());
  EXPECT_FALSE(parse_analysis_settings({"event_size_min=fit"}).event_size_min.has_value());
  EXPECT_EQ(parse_analysis_settings({"threshold_factors=[1, 2.5]"}).threshold_factors,
            (std::vector{1.0, 2.5}));
}

TEST(AnalysisParameters, out_of_range_are_refused) {
  for (const char* setting : {"threshold_factors=",
                              "threshold_factors=2,1",
                              "threshold_factors=1,1",
                              "threshold_factors=1,,2",
                              "threshold_factors=1,2,3,4,5",
                              "threshold_factors=0",
                              "gamma_c=0",
                              "gamma_c=1.5",
                              "gamma_c=nan",
                              "gamma_c=sin",
                              "l_min=-1",
                              "l_min=101",
                              "l_min=",
                              "lc_cut=-3",
                              "lc_cut=30m",
                              "lc_cut=inf",
                              "joining=contact",
                              "averaging=-1",
                              "averaging=11",
                              "min_contacts=0",
                              "sections=0",
                              "sections=2.5",
                              "bins=1001",
                              "event_velocity=0",
                              "event_velocity=tolerance",
                              "event_quiet=-1",
                              "event_displacement=-0.1",
                              "event_size_min=0",
                              "bins="})
    EXPECT_NE(refusal({setting}).find(std::string("--set ") + setting + ": error: key '"), std::string::npos)
        << refusal({setting});
}

TEST(AnalysisParameters, are_refused_all_at_once_and_say_what_was_expected) {
  EXPECT_EQ(
      refusal({"lc_cut=-3", "colour=red", "bins", "gamma_c=0.3", "gamma_c=run"}),
      "--set lc_cut=-3: error: key 'lc_cut' = -3: expected a number in (0, 10000] or \"depth\", in D\n"
      "--set colour=red: error: unknown key 'colour'; expected one of threshold_factors, gamma_c, l_min, "
      "lc_factor, lc_cut, joining, averaging, min_contacts, sections, bins, event_velocity, event_quiet, "
      "event_displacement, event_size_min\n"
      "--set bins: error: key 'bins' has no value: expected key=value, such as --set lc_cut=30\n"
      "--set gamma_c=run: error: key 'gamma_c' is set twice on the command line; expected it once");
  EXPECT_EQ(refusal({"threshold_factors=2,1"}),
            "--set threshold_factors=2,1: error: key 'threshold_factors': expected 1 ... 4 ascending numbers "
            "in (0, 10], with commas between, in Gamma_c");
  EXPECT_EQ(refusal({"sections=2.5"}),
            "--set sections=2.5: error: key 'sections' = 2.5: expected an integer in 1 ... 1000, found a "
            "float");
}

TEST(AnalysisParameters, that_are_mistyped_are_recognised) {
  const std::pair<std::string, std::string> slips[] = {{"gama_c=0.3", "gamma_c"},
                                                       {"overload.thresold=1", "threshold_factors"},
                                                       {"overload.lc_cut=1", "lc_cut"},
                                                       {"contacts=3", "min_contacts"}};
  for (const auto& [setting, meant] : slips)
    EXPECT_NE(refusal({setting}).find("; did you mean '" + meant + "'?"), std::string::npos)
        << refusal({setting});
}

TEST(AnalysisParameters, are_documented_as_they_are) {
  std::string expected;
  for (const AnalysisKey& key : analysis_keys())
    expected += row_text(key, scenario::plain_text(key.get(analysis::AnalysisParameters{})));
  EXPECT_EQ(rows_of("docs/analysis.md"), expected) << "the table of docs/analysis.md must be:\n" << expected;
}

}  // namespace
}  // namespace talus::runs
