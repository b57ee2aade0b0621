/// Quantities of single grains agree with talus export and docs/view.md, and conditions find them.

#include "view/grain_quantities.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fmt/core.h>
#include <fstream>
#include <iterator>

#include "analysis/frame_analysis.h"
#include "analysis/quantities.h"
#include "core/trigonometry.h"
#include "io/run_schema.h"
#include "pictures/overload_rule.h"
#include "runs/analysis_input.h"
#include "support/places.h"
#include "support/temporary_folder.h"
#include "unit/view/example_bed.h"
#include "unit/view/opened_view.h"

namespace talus::view {
namespace {

class GrainQuantities : public testing::Test {
 protected:
  GrainQuantities() {
    frame_.image[3] = 1;
    frame_.vx[4] = 3.0;
    frame_.vy[4] = -4.0;
    frame_.contacts.status[0] = ContactStatus::sliding;
    judged_.cluster = pictures::overloaded_clusters({frame_, statics_}, rule_).label;
  }
  analysis::GrainSource source() { return {{frame_, statics_}, 2, frame_.gamma, &first_, {}, {&judged_, 1}}; }
  std::vector<Index> where(const std::string& condition) {
    return grains_where(parse_condition(condition, grain_names()), source());
  }

  RunStatics statics_ = example::bed_statics();
  Frame first_ = example::bed_frame(0.0, 0), frame_ = example::bed_frame(10.0, 2);
  pictures::OverloadRule rule_{.theta_c = radians(20.0), .l_min = 0.0};
  analysis::FrameThreshold judged_;
};

TEST_F(GrainQuantities, a_condition_finds_free_grains) {
  EXPECT_EQ(where("gamma > 0.7"), (std::vector<Index>{0, 10}));
  EXPECT_EQ(where("gamma > 0.7 && y > 1"), (std::vector<Index>{10}));
  EXPECT_EQ(where("overloaded || speed == 5"), (std::vector<Index>{0, 4, 10}));
  EXPECT_EQ(where("displacement_x == 10"), (std::vector<Index>{3})) << "once around";
  EXPECT_EQ(where("sliding == 1"), (std::vector<Index>{0}));
  EXPECT_EQ(where("y > -100").size(), static_cast<std::size_t>(statics_.free_count)) << "no floor";
  EXPECT_TRUE(where("y > 100").empty());
}

TEST_F(GrainQuantities, all_have_a_value_for_each_grain) {
  for (const analysis::GrainNumber& number : analysis::grain_numbers())
    EXPECT_EQ(analysis::values_of(number, source()).size(), frame_.x.size()) << number.name;
}

TEST_F(GrainQuantities, without_a_first_frame_nothing_is_said_of_displacements) {
  const analysis::GrainSource source = {{frame_, statics_}};
  EXPECT_TRUE(std::isnan(analysis::values_of(analysis::grain_number("displacement_x"), source)[3]));
  EXPECT_TRUE(std::isnan(analysis::values_of(analysis::grain_number("displacement_y"), source)[3]));
}

TEST(GrainQuantitiesOfARun, are_judged_as_the_analysis_does) {
  const test::TemporaryFolder folder;
  example::write_bed_run(folder.path("run.h5"), 20.0);
  const io::RunFile file = io::RunFile::open(folder.path("run.h5"));
  analysis::AnalysisParameters parameters;
  parameters.l_min = 0.0;
  parameters.threshold_factors = {1.0};
  const RunStatics& statics = file.header().statics;
  const Frame frame = runs::analysed_frame(file, parameters, 2);
  const analysis::FrameThreshold judged =
      analysis::analyse_thresholds({frame, statics}, parameters,
                                   analysis::begin_analysis(statics, parameters, radians(20.0)), 1.0)
          .at(0);
  ViewModel model = example::opened(folder.path("run.h5"));
  model.go_to(2);
  const auto values = [&](const char* name) { return model.grain_values(analysis::grain_number(name)); };
  int overloaded = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(statics.free_count); ++i) {
    EXPECT_EQ(values("gamma_neighbourhood")[i], frame.gamma[i]) << i;
    EXPECT_EQ(values("cluster")[i], judged.cluster[i]) << i;
    EXPECT_EQ(values("overloaded")[i], judged.cluster[i] >= 0 ? 1.0 : 0.0) << i;
    EXPECT_EQ(std::isnan(values("lc")[i]), judged.cluster[i] < 0) << i;
    if (judged.cluster[i] < 0) continue;
    ++overloaded;
    EXPECT_DOUBLE_EQ(values("lc")[i] * statics.mean_diameter, judged.lc[i]) << i;
  }
  EXPECT_GT(overloaded, 0);
}

/// Grain 39 is raised by 1 m = D between the frames at 5 and 10 deg.
TEST(GrainQuantitiesOfARun, are_measured_since_the_frame_that_the_map_goes_by) {
  const test::TemporaryFolder folder;
  example::write_bed_run(folder.path("run.h5"), 20.0);
  ViewModel model = example::opened(folder.path("run.h5"));
  model.go_to(2);
  const auto distance = [&] { return model.grain_values(analysis::grain_number("distance"))[39]; };
  EXPECT_NEAR(distance(), 0.2, 1e-6) << "per degree since the previous frame";
  model.state.since = radians(0.0);
  EXPECT_NEAR(distance(), 1.0, 1e-6) << "in total";
  model.state.map.layers = {pictures::MapKind::displacement};
  model.first().map(2.0);
  EXPECT_EQ(model.first().values().values[39], distance()) << "as in the map";
  model.state.selecting.condition = "distance > 0.5";
  model.select_by_condition();
  EXPECT_EQ(model.selected_grains(), std::vector<Index>{39});
  model.go_to(1);
  EXPECT_EQ(distance(), 0.0);
}

TEST(GrainQuantitiesOfPages, docs_list_those_that_no_export_has) {
  std::ifstream file(test::source_folder() + "/docs/view.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  std::string rows;
  for (const analysis::FrameQuantity& quantity : analysis::grain_quantities())
    if (!analysis::is_of_frame(quantity))
      rows += fmt::format("| `{}` | {} | {} |\n", quantity.name, analysis::scaled_unit(quantity.unit),
                          quantity.definition);
  EXPECT_NE(page.find("|---|---|---|\n" + rows + "\n"), std::string::npos) << rows;
}

/// SI values in the window have the unit in the attribute of their data set: per metre of thickness.
TEST(GrainQuantitiesOfARun, have_the_units_of_the_run_file) {
  const std::pair<const char*, const char*> same[] = {
      {"mass", "/particles/grains/mass"},
      {"velocity_x", "/particles/grains/velocity/value"},
      {"velocity_y", "/particles/grains/velocity/value"},
      {"angular_velocity", "/particles/grains/angular_velocity/value"},
      {"internal_moment_xx", "/particles/grains/internal_moment/value"},
      {"internal_moment_yx", "/particles/grains/internal_moment/value"},
      {"pressure", "/observables/sigma_n"}};
  for (const auto& [name, data_set] : same)
    EXPECT_EQ(std::string(analysis::grain_number(name).quantity->unit), io::field_of(data_set).unit) << name;
  const std::pair<const char*, const char*> per_metre[] = {{"/contacts/force", "N/m"},
                                                           {"/observables/kinetic_energy", "J/m"},
                                                           {"/particles/grains/internal_moment/value", "J/m"},
                                                           {"/particles/grains/mass", "kg/m"},
                                                           {"/checkpoint/contact_force", "N/m"},
                                                           {"/branch/contact_force", "N/m"},
                                                           {"/branch/mass", "kg/m"}};
  for (const auto& [data_set, unit] : per_metre) EXPECT_EQ(io::field_of(data_set).unit, unit) << data_set;
}

}  // namespace
}  // namespace talus::view
