/// Tables behind the paper's curves, from hand-made analyses.

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "analysis/overload/coarse_graining.h"
#include "figures/catalogue.h"
#include "figures/group_table.h"
#include "figures/recipes.h"
#include "figures/run_means.h"
#include "figures/wall_fit.h"
#include "stress/overload.h"
#include "unit/figures/example_figure_run.h"

namespace talus::figures {
namespace {

const std::vector<double>& column(const Table& table, const std::string& name) {
  for (const Column& each : table.columns)
    if (each.name == name) return each.values;
  throw std::out_of_range(name);
}

/// Returns the table of a figure whose name begins with `beginning`.
const Table& table_called(const Figure& figure, const std::string& beginning) {
  for (const Table& table : figure.tables)
    if (table.name.starts_with(beginning)) return table;
  throw std::out_of_range(beginning);
}

std::string variable(const Figure& figure, const std::string& name) {
  for (const auto& [key, value] : figure.variables)
    if (key == name) return value;
  return "not there";
}

/// Periodic group of three runs: two fail after all three frames, and one does not fail.
class Curves : public ::testing::Test {
 protected:
  Curves() {
    example::store_with_commits(path_, 4);
    groups_.resize(1);
    groups_[0].label = "PBC, a_b";
    for (const double theta_c : {80.0, 80.0, std::nan("")})
      groups_[0].runs.push_back(example::figure_run(path_, groups_[0].runs.size() + 1, theta_c));
  }

  /// Fills run r with r + 1 times `first`, increasing by `step` between elements.
  void fill(const analysis::QuantityMember& member, double first, double step) {
    const analysis::Quantity& quantity = analysis::quantity_of(member);
    for (std::size_t r = 0; r < groups_[0].runs.size(); ++r) {
      analysis::Analysis& analysis = groups_[0].runs[r].analysis;
      if (!io::is_present(quantity, analysis)) continue;
      auto all = std::get<std::vector<double>>(analysis::values_of(quantity, analysis));
      for (std::size_t k = 0; k < all.size(); ++k)
        all[k] = static_cast<double>(r + 1) * first + static_cast<double>(k) * step;
      analysis::set_values(quantity, all, analysis);
    }
  }

  /// Changes the beds to beds between walls, 20 and 40 D deep, with ratios of 0.5 and 1 at failure.
  void use_walls() {
    const runs::RunView& run = groups_[0].runs[0];
    const double length = run.scenario.bed.length, diameter = run.statics.mean_diameter;
    groups_[0].runs[0].scenario.bed.boundary = scenario::BedBoundary::walls;
    fill(&analysis::Analysis::failure_ratio, 0.5, 0.0);
    fill(&analysis::Analysis::failure_ratio_spread, 0.1, 0.0);
    fill(&analysis::FrameRecord::volume, 20.0 * length * diameter * diameter, 0.0);
  }

  test::TemporaryFolder folder_;
  std::string path_ = folder_.path("run.h5");
  std::vector<RunGroup> groups_;
};

TEST_F(Curves, OfThePackingAreMeansOverAllRuns) {
  fill(&analysis::FrameRecord::stress_ratio, 0.1, 0.01);
  const auto figure = stress_ratio_figure(groups_);
  ASSERT_TRUE(figure);
  ASSERT_EQ(figure->tables.size(), 2u);
  EXPECT_EQ(figure->tables[0].name, "pbc-a_b");
  EXPECT_EQ(figure->runs.size(), 3u);
  EXPECT_EQ(column(figure->tables[0], "n"), (std::vector<double>{3.0, 3.0, 3.0}));
  EXPECT_NEAR(column(figure->tables[0], "ratio")[1], 0.21, 1e-15);
  EXPECT_NEAR(column(figure->tables[0], "ratio_error")[1], 0.1 / std::sqrt(3.0), 1e-15);
  EXPECT_EQ(variable(*figure, "label_1"), "'PBC, a\\_b (3 runs)'") << "no subscript in the key";
  EXPECT_EQ(variable(*figure, "data_1"), "\"fig05-stress-ratio-pbc-a_b.csv\"");
}

TEST_F(Curves, OfBedsThatSlopeToTheOtherSideAreMirrored) {
  fill(&analysis::FrameRecord::sigma_t_over_n, -0.1, -0.01);
  fill(&analysis::FrameRecord::stress_ratio, 0.1, 0.01);
  for (runs::RunView& run : groups_[0].runs)
    for (std::size_t k = 0; k < 3; ++k) run.analysis.frames[k].tilt = radians(-static_cast<double>(k));
  const auto shear = shear_stress_figure(groups_), ratio = stress_ratio_figure(groups_);
  EXPECT_NEAR(column(shear->tables[0], "ratio")[1], 0.21, 1e-15);
  EXPECT_NEAR(column(ratio->tables[0], "ratio")[1], 0.21, 1e-15);
  EXPECT_NEAR(column(shear->tables[0], "theta")[1], 1.0, 1e-12);
}

TEST_F(Curves, AreOfAnyQuantityOfFrames) {
  const analysis::Quantity made_up = {
      &analysis::FrameThreshold::lc_max, "lc/made_up", "T F", "m", "made up for this test", ""};
  fill(made_up.member, 1.0, 0.0);
  const FrameColumn frame_column = column_of("made_up", made_up, 1);
  const RunChoice runs = runs_with_threshold(groups_[0]);
  const Table table = {"", means_over_runs(runs, {&frame_column, 1})};
  const double diameter = groups_[0].runs[0].file->header().statics.mean_diameter;
  EXPECT_NEAR(column(table, "made_up")[1], 1.5 / diameter, 1e-9) << "mean of two runs, in D";
  EXPECT_EQ(table.columns[2].unit, "D");
  EXPECT_EQ(table.columns[2].meaning, made_up.definition);
}

TEST_F(Curves, EndAtTheFailureOfEachRun) {
  const std::vector<double> tilts = groups_[0].runs[0].file->frame_tilts();
  groups_[0].runs[0].analysis.theta_c = 0.5 * (tilts[1] + tilts[2]);
  const auto figure = stress_ratio_figure(groups_);
  EXPECT_EQ(column(figure->tables[0], "n"), (std::vector<double>{3.0, 3.0, 2.0}));
}

TEST_F(Curves, HaveTheRunsOneByOneBehindThem) {
  fill(&analysis::FrameRecord::stress_ratio, 0.1, 0.01);
  const std::vector<double> tilts = groups_[0].runs[0].file->frame_tilts();
  groups_[0].runs[0].analysis.theta_c = 0.5 * (tilts[1] + tilts[2]);
  const auto figure = stress_ratio_figure(groups_);
  const Table& runs = table_called(*figure, "pbc-a_b-runs");
  EXPECT_TRUE(runs.in_blocks);
  EXPECT_EQ(column(runs, "seed"), (std::vector<double>{1, 1, 2, 2, 2, 3, 3, 3})) << "each up to its failure";
  EXPECT_NEAR(column(runs, "theta")[4], degrees(tilts[2]), 1e-12);
  EXPECT_NEAR(column(runs, "ratio")[4], 0.22, 1e-15);
  EXPECT_EQ(variable(*figure, "runs_1"), "\"fig05-stress-ratio-pbc-a_b-runs.csv\"");
  EXPECT_EQ(variable(*figure, "drawn_1"), "3");
  EXPECT_EQ(variable(*figure, "spread"), "1");
  groups_[0].runs.resize(1);
  const auto single = stress_ratio_figure(groups_);
  EXPECT_EQ(single->tables.size(), 1u);
  EXPECT_EQ(variable(*single, "spread"), "not there");
}

TEST_F(Curves, OverTheAngleThatIsLeftAreAtTheSameDistanceFromEachFailure) {
  fill(&analysis::FrameRecord::stress_ratio, 0.0, 0.01);  // 0, 0.01 and 0.02 in the three frames of each run
  for (runs::RunView& run : groups_[0].runs) {
    run.scenario.output.frame_every = 0.5;
    for (std::size_t k = 0; k < 3; ++k) run.analysis.frames[k].tilt = radians(static_cast<double>(k));
  }
  groups_[0].runs[0].analysis.theta_c = radians(2.25);
  groups_[0].runs[1].analysis.theta_c = radians(2.0);
  const auto figure = quantities_before_failure(groups_);
  ASSERT_TRUE(figure);
  const Table& table = figure->tables[0];
  EXPECT_EQ(figure->runs.size(), 2u) << "those that have failed";
  const std::vector<double>& left = column(table, "angle_left");
  ASSERT_EQ(left.size(), 5u);
  EXPECT_NEAR(left[1], 0.5, 1e-9);
  EXPECT_EQ(column(table, "n")[0], 1.0) << "a frame exists at the failure of the second";
  EXPECT_EQ(column(table, "n")[1], 2.0);
  EXPECT_NEAR(column(table, "packing/stress_ratio")[0], 0.02, 1e-9);
  EXPECT_NEAR(column(table, "packing/stress_ratio")[1], 0.5 * (0.0175 + 0.015), 1e-9);
  EXPECT_NEAR(column(table, "packing/stress_ratio_deviation")[1], 0.0025 / std::sqrt(2.0), 1e-9);
}

TEST_F(Curves, OfAllQuantitiesAreThoseWithATitleAndAValue) {
  fill(&analysis::FrameRecord::stress_ratio, 0.1, 0.01);
  fill(&analysis::FrameThreshold::lc_mean, 0.02, 0.0);
  const auto figure = quantities_over_tilt(groups_);
  ASSERT_TRUE(figure);
  EXPECT_EQ(variable(*figure, "panels"), "2");
  EXPECT_EQ(variable(*figure, "quantity_1"), "\"packing/stress_ratio\"");
  EXPECT_EQ(variable(*figure, "quantity_2"), "\"lc/mean\"");
  EXPECT_EQ(variable(*figure, "title_2"), "\"Mean ℓ_c of the overloaded grains in D\"");
  EXPECT_EQ(variable(*figure, "rows"), "1");
  EXPECT_NEAR(column(figure->tables[0], "lc/mean")[0], 0.03 / groups_[0].runs[0].statics.mean_diameter, 1e-9);
}

TEST_F(Curves, DifferencesAreOfTwoGroupsWithBothErrors) {
  fill(&analysis::FrameRecord::stress_ratio, 0.1, 0.01);
  EXPECT_FALSE(differences_over_tilt(groups_)) << "one group";
  groups_.resize(2);
  groups_[1].label = "other";
  for (const std::uint64_t seed : {1, 2}) groups_[1].runs.push_back(example::figure_run(path_, seed, 80.0));
  for (runs::RunView& run : groups_[1].runs) {
    for (std::size_t k = 0; k < 3; ++k)
      run.analysis.frames[k].stress_ratio = 1.0 + 0.3 * static_cast<double>(run.scenario.seed);
    run.analysis.frames[1].tilt += radians(0.1);  // gives the run a different grid of tilts
  }
  const auto figure = differences_over_tilt(groups_);
  ASSERT_TRUE(figure);
  EXPECT_EQ(figure->runs.size(), 5u);
  const Table& table = figure->tables[0];
  ASSERT_EQ(column(table, "theta").size(), 2u) << "tilts common to both";
  EXPECT_NEAR(column(table, "packing/stress_ratio")[0], 1.45 - 0.2, 1e-12) << "the second minus the first";
  EXPECT_NEAR(column(table, "packing/stress_ratio")[1], 1.45 - 0.22, 1e-12);
  EXPECT_NEAR(column(table, "packing/stress_ratio_error")[0], std::hypot(0.15, 0.1 / std::sqrt(3.0)), 1e-12);
  EXPECT_EQ(variable(*figure, "label"), "'other − PBC, a\\_b'");
  EXPECT_EQ(variable(*figure, "panels"), "1");
  EXPECT_TRUE(differences_before_failure(groups_));
  groups_.push_back({"third", {}});
  groups_[2].runs.push_back(example::figure_run(path_, 1, 80.0));
  EXPECT_FALSE(differences_over_tilt(groups_)) << "three groups";
}

TEST_F(Curves, OfCriticalContactsNeedNoMap) {
  const auto mapped = critical_contacts_figure(groups_);
  ASSERT_TRUE(mapped);
  EXPECT_EQ(variable(*mapped, "letters"), "\"bcd\"");
  for (runs::RunView& run : groups_[0].runs) run.file.reset();
  const auto values = critical_contacts_figure(groups_);
  ASSERT_TRUE(values);
  EXPECT_EQ(variable(*values, "letters"), "\"abc\"");
  EXPECT_EQ(variable(*values, "map_height"), "0");
  EXPECT_LT(values->height_over_width, mapped->height_over_width);
  for (const FigureRecipe& recipe : figure_catalogue())
    if (recipe.material == Material::frames) {
      EXPECT_FALSE(recipe.make(groups_)) << recipe.name << " has no file from which it is made";
    }
}

TEST_F(Curves, OfDistributionsNeedNoFile) {
  fill(&analysis::FrameRecord::gamma_density, 1.0, 0.0);
  for (runs::RunView& run : groups_[0].runs) run.file.reset();
  const auto figure = gamma_density_figure(groups_);
  ASSERT_TRUE(figure);
  EXPECT_EQ(column(figure->tables[0], "density_0"), (std::vector<double>{1.5, 1.5}));
  for (runs::RunView& run : groups_[0].runs) run.analysis.gamma_edge.clear();
  for (const FigureRecipe& recipe : figure_catalogue())
    if (recipe.material == Material::distributions) {
      EXPECT_FALSE(recipe.make(groups_)) << recipe.name << " has no distributions from which it is made";
    }
}

TEST_F(Curves, OfOverloadedGrainsNeedAThreshold) {
  fill(&analysis::FrameThreshold::overloaded_fraction, 0.2, 0.05);  // elements in the order frame, threshold
  const auto figure = overloaded_fraction_figure(groups_);
  ASSERT_TRUE(figure);
  EXPECT_EQ(figure->runs.size(), 2u) << "the third has none";
  EXPECT_EQ(variable(*figure, "thresholds"), "2");
  EXPECT_NEAR(column(figure->tables[0], "p_o_1")[1], 0.4, 1e-15) << "mean of 0.3 and 0.5";
  EXPECT_NEAR(column(figure->tables[0], "p_o_2")[1], 0.45, 1e-15);
  EXPECT_EQ(column(table_called(*figure, "paper"), "p_o"), (std::vector<double>{0.30, 0.45, 0.60}))
      << "the paper";
  groups_[0].runs.erase(groups_[0].runs.begin(), groups_[0].runs.begin() + 2);
  EXPECT_FALSE(overloaded_fraction_figure(groups_));
  EXPECT_FALSE(length_figure(groups_));
}

TEST_F(Curves, OfLengthsAreInDiameters) {
  const double diameter = groups_[0].runs[0].file->header().statics.mean_diameter;
  fill(&analysis::FrameThreshold::lc_mean, 2.0 * diameter, 0.0);
  fill(&analysis::FrameThreshold::lc_max, 10.0 * diameter, 0.0);
  fill(&analysis::Analysis::lc_cut, 15.0 * diameter, 0.0);
  groups_[0].runs[0].analysis.lc_cut = 40.0 * diameter;
  const auto figure = length_figure(groups_);
  EXPECT_NEAR(column(figure->tables[0], "mean_1")[0], 3.0, 1e-12);
  EXPECT_NEAR(column(figure->tables[0], "max_2")[2], 15.0, 1e-12);
  EXPECT_NEAR(std::stod(variable(*figure, "cut_1")), 40.0, 1e-12) << "the largest of the runs";
  EXPECT_NEAR(std::stod(variable(*figure, "top")), 40.0, 1e-12);
}

TEST_F(Curves, OfLengthsHaveTheCutOfEachBedAndAllThatThePaperFound) {
  const double diameter = groups_[0].runs[0].file->header().statics.mean_diameter;
  RunGroup other;
  other.label = "deeper";
  other.runs.push_back(std::move(groups_[0].runs.front()));
  groups_[0].runs.erase(groups_[0].runs.begin());
  groups_.push_back(std::move(other));
  for (runs::RunView& run : groups_[0].runs) run.analysis.lc_cut = 6.0 * diameter;
  for (runs::RunView& run : groups_[1].runs) run.analysis.lc_cut = 10.0 * diameter;
  const auto figure = length_figure(groups_);
  EXPECT_NEAR(std::stod(variable(*figure, "cut_1")), 6.0, 1e-12);
  EXPECT_NEAR(std::stod(variable(*figure, "cut_2")), 10.0, 1e-12);
  EXPECT_GE(std::stod(variable(*figure, "top")), 30.0)
      << "the limited l_c of a shallow bed must not remove the paper's crosses";
}

TEST_F(Curves, OfGammaAreThoseOfRunsThatStandAtTheAngle) {
  fill(&analysis::FrameRecord::gamma_density, 1.0, 0.0);
  const auto figure = gamma_density_figure(groups_);
  EXPECT_EQ(column(figure->tables[0], "density_0"), (std::vector<double>{1.5, 1.5}));
  for (runs::RunView& run : groups_[0].runs) run.analysis.theta_c = radians(5.0);
  const auto early = gamma_density_figure(groups_);
  EXPECT_TRUE(std::isnan(column(early->tables[0], "density_10")[0]));
  EXPECT_EQ(variable(*early, "shown"), gnuplot_string("0")) << "the key lists no angle that no bed reaches";
}

TEST_F(Curves, OverScaleAreOfFailedRunsAtTheAngles) {
  const auto figure = overload_scale_figure(groups_);
  ASSERT_TRUE(figure);
  EXPECT_EQ(figure->runs.size(), 2u) << "those that have failed";
  const Table& table = figure->tables[0];
  const std::vector<double>& scales = column(table, "l");
  EXPECT_EQ(scales.front(), 0.0) << "the grain alone";
  const io::RunFile& run = *groups_[0].runs[0].file;
  const RunStatics& statics = run.header().statics;
  for (std::size_t s = 0; s < scales.size(); ++s) {
    const double l =
        std::max(scales[s], 1e-9) * statics.mean_diameter;  // scale 0 uses the value of the frame itself
    const Frame frame = analysis::with_gamma_of_neighbourhoods(run.frame(0), statics, l);
    EXPECT_NEAR(column(table, "p_o_0")[s],
                stress::count_overloaded({frame, statics}, sine(radians(80.0))).fraction(), 1e-12)
        << scales[s];
    EXPECT_EQ(column(table, "p_o_0_error")[s], 0.0) << "both runs are the same";
  }
  EXPECT_EQ(column(table, "p_o_repose").size(), scales.size());
  for (runs::RunView& each : groups_[0].runs) each.analysis.theta_c = radians(5.0);
  EXPECT_TRUE(std::isnan(column(overload_scale_figure(groups_)->tables[0], "p_o_15")[0]))
      << "no run remained stable";
}

TEST_F(Curves, CaptionsSayWhoseGammaItIs) {
  EXPECT_NE(overloaded_fraction_figure(groups_)->caption.find(
                "its first neighbours, a neighbourhood of diameter 3 D"),
            std::string::npos);
  for (runs::RunView& run : groups_[0].runs) run.analysis.parameters = {{"l_min", "0"}};
  EXPECT_NE(overloaded_fraction_figure(groups_)->caption.find("gamma is that of single grains"),
            std::string::npos);
  EXPECT_NE(gamma_density_figure(groups_)->caption.find("gamma is that of single grains"), std::string::npos);
}

TEST_F(Curves, OfTheVolumeHaveNumbersThatDoNotTouch) {
  fill(&analysis::FrameRecord::volume_strain, 0.0, 0.01);
  fill(&analysis::FrameRecord::centre_of_mass_strain, 0.0, -0.002);
  const auto figure = volume_strain_figure(groups_);
  EXPECT_EQ(std::stod(variable(*figure, "step_volume_strain")), 5.0) << "of 20e-3";
  EXPECT_EQ(std::stod(variable(*figure, "step_centre_of_mass_strain")), 1.0) << "of -4e-3";
}

TEST_F(Curves, OfTheVolumeHaveThetaDByEachEstimator) {
  fill(&analysis::RunThreshold::lc_jump, radians(10.0), radians(1.0));
  fill(&analysis::Analysis::dilation, radians(5.0), 0.0);
  const auto figure = volume_strain_figure(groups_);
  ASSERT_EQ(figure->tables.size(), 3u);
  const Table& table = table_called(*figure, "theta_d-");
  EXPECT_EQ(table.name, "theta_d-pbc-a_b");
  EXPECT_EQ(column(table, "n"), (std::vector<double>{3.0, 3.0, 0.0, 0.0, 2.0, 2.0}));
  EXPECT_NEAR(column(table, "theta_d")[0], 10.0, 1e-12) << "dilation, mean of 5, 10, 15";
  EXPECT_NEAR(column(table, "theta_d")[5], 15.0, 1e-12) << "jump at Gamma_c, mean of 10 and 20";
  EXPECT_NEAR(column(table, "theta_d")[4], 16.0, 1e-12) << "at 2 Gamma_c, of 11 and 21";
  EXPECT_NEAR(column(table, "theta_d_error")[5], 5.0, 1e-12);
  EXPECT_TRUE(std::isnan(column(table, "theta_d")[2])) << "no percolation";
}

TEST_F(Curves, AreCalledAsInTheCatalogue) {
  for (const std::string_view name :
       {"fig04-shear-stress", "fig05-stress-ratio", "fig08-stress-ratio-density", "fig09-overloaded-fraction",
        "fig12-coarse-graining-length", "fig14-volume-strain", "overloaded-over-scale", "over-tilt",
        "before-failure", "precursors"}) {
    const auto recipe = std::ranges::find(figure_catalogue(), name, &FigureRecipe::name);
    ASSERT_NE(recipe, figure_catalogue().end()) << name;
    const auto figure = recipe->make(groups_);
    ASSERT_TRUE(figure) << name;
    EXPECT_EQ(figure->name, name);
    EXPECT_EQ(figure->title, recipe->title);
  }
}

TEST_F(Curves, OfPeriodicBedsLeaveOutWalls) {
  groups_[0].runs[0].scenario.bed.boundary = scenario::BedBoundary::walls;
  EXPECT_FALSE(overloaded_fraction_figure(groups_));
  EXPECT_FALSE(volume_strain_figure(groups_));
  EXPECT_TRUE(stress_ratio_figure(groups_));
}

TEST_F(Curves, OfWallsAreThoseOfTheShortestBed) {
  EXPECT_FALSE(wall_stress_figure(groups_)) << "a periodic bed";
  groups_[0].runs[0].scenario.bed.boundary = scenario::BedBoundary::walls;
  fill(&analysis::FrameRecord::section_sigma_xx, 100.0, 0.0);
  const RunStatics& statics = groups_[0].runs[0].file->header().statics;
  double mass = 0.0;
  for (Index i = 0; i < statics.free_count; ++i) mass += statics.mass[i];
  const auto figure = wall_stress_figure(groups_);
  ASSERT_TRUE(figure);
  EXPECT_EQ(figure->runs.size(), 2u) << "those that have failed";
  EXPECT_NEAR(column(figure->tables[0], "sigma_xx_0")[0],
              150.0 * 2.0 * statics.length / (mass * statics.gravity), 1e-12);
}

TEST_F(Curves, OfWallsNeedNumbersOnly) {
  use_walls();
  for (runs::RunView& run : groups_[0].runs) run.file.reset();
  const auto figure = wall_ratio_figure(groups_);
  ASSERT_TRUE(figure);
  const Table& table = figure->tables[0];
  EXPECT_EQ(column(table, "n"), (std::vector<double>{2.0}));
  EXPECT_NEAR(column(table, "ratio")[0], 0.75, 1e-12) << "mean of 0.5 and 1";
  EXPECT_NEAR(column(table, "ratio_spread")[0], std::sqrt((0.01 + 0.04) / 2.0), 1e-12);
  EXPECT_NEAR(column(table, "H")[0], 30.0, 1e-9) << "mean of 20 and 40 D";
}

TEST_F(Curves, OfWallsLeaveOutRunsWithoutARatio) {
  use_walls();
  for (runs::RunView& run : groups_[0].runs)
    if (run.analysis.failure_ratio == 1.0) run.analysis.failure_ratio = not_known;
  const auto figure = wall_ratio_figure(groups_);
  ASSERT_TRUE(figure);
  const Table& table = figure->tables[0];
  EXPECT_EQ(column(table, "n"), (std::vector<double>{1.0}));
  EXPECT_NEAR(column(table, "ratio")[0], 0.5, 1e-12);
  EXPECT_NEAR(column(table, "H")[0], 20.0, 1e-9);
  EXPECT_EQ(figure->caption.find("nan"), std::string::npos) << figure->caption;
}

TEST(GnuplotQuoted, StandsForItself) {
  EXPECT_EQ(gnuplot_quoted("a_b^{c}@d's"), "'a\\_b\\^\\{c\\}\\@d''s'");
  EXPECT_EQ(gnuplot_string("θ_c"), "\"θ_c\"");
}

}  // namespace
}  // namespace talus::figures
