/// The ranking of what announces failure, on hand-made beds.

#include "figures/ranking_figure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/random.h"
#include "core/trigonometry.h"
#include "support/blank_analysis.h"

namespace talus {
namespace {

/// Twelve beds that fail from 18 to 22 deg. z tells the distance from failure, Gamma the tilt, nu nothing;
/// the mean l_c at both thresholds tells it with an offset of each bed, and p_o is the same in all beds.
class Ranking : public ::testing::Test {
 protected:
  Ranking() {
    groups.resize(1);
    groups[0].label = "PBC";
    for (std::uint64_t seed = 1; seed <= 12; ++seed) groups[0].runs.push_back(bed(seed));
  }

  static RunView bed(std::uint64_t seed) {
    RunView run;
    run.path = "e.h5#seed-" + std::to_string(seed);
    run.statics.mean_diameter = 1.0;
    run.scenario.seed = seed;
    Random random(seed);
    const double theta_c = 18.0 + 4.0 * static_cast<double>((5 * seed) % 12) / 11.0;
    run.analysis = test::blank_analysis({.frames = 92, .thresholds = 2});
    run.analysis.theta_c = radians(theta_c);
    run.analysis.gamma_c = sine(radians(theta_c));
    run.analysis.thresholds[0].factor = 1.0;
    run.analysis.thresholds[1].factor = 2.0;
    const double offset = random.uniform(-1.0, 1.0);
    for (std::size_t k = 0; k < run.analysis.frames.size(); ++k) {
      FrameRecord& frame = run.analysis.frames[k];
      const double tilt = 0.25 * static_cast<double>(k), left = std::max(0.0, theta_c - tilt);
      frame.tilt = radians(tilt);
      frame.coordination_number = 3.0 + 0.5 * std::exp(-left / 3.0) * (1.0 + 0.01 * random.uniform());
      frame.stress_ratio = sine(frame.tilt) * (1.0 + 1e-4 * random.uniform());
      frame.critical_share = random.uniform();
      frame.gamma_mean = (2.0 + offset) * (1.0 + std::exp(-left / 3.0)) * (1.0 + 0.001 * random.uniform());
      frame.volume_strain = offset + std::exp(-left / 3.0) + 0.05 * random.uniform();
      for (FrameThreshold& at : frame.thresholds) {
        at.lc_mean = 10.0 - left + offset;
        at.overloaded_fraction = 0.5;
      }
    }
    return run;
  }

  const RankedMeasure& measure(const std::string& name) const {
    const auto found = std::ranges::find(ranked, name, &RankedMeasure::name);
    if (found == ranked.end()) throw std::out_of_range(name);
    return *found;
  }

  std::vector<RunGroup> groups;
  std::vector<RankedMeasure> ranked;
};

TEST_F(Ranking, HasTheBestMeasureFirst) {
  ranked = ranked_measures(groups[0]);
  EXPECT_EQ(ranked.front().name, "contacts/coordination_number");
  EXPECT_LT(ranked.front().error.value, 0.2);
  EXPECT_LT(ranked.front().error_with_tilt.value, 0.2);
  EXPECT_GT(ranked.front().gain, 3.0 * ranked.front().gain_error);
  EXPECT_GT(ranked.front().contrast[0], ranked.front().contrast[2]) << "it changes towards failure";
  EXPECT_TRUE(std::ranges::is_sorted(ranked, {}, [](const RankedMeasure& each) { return each.error.value; }));
}

TEST_F(Ranking, HasTheTiltToCompareWith) {
  ranked = ranked_measures(groups[0]);
  const double tilt = measure("tilt").error.value;
  EXPECT_GT(tilt, 0.7);
  EXPECT_LT(tilt, 1.5) << "theta_c scatters by 1.3 deg";
  EXPECT_NEAR(measure("packing/stress_ratio").error.value, tilt, 0.02) << "sin(theta) says what theta says";
  EXPECT_NEAR(measure("packing/stress_ratio").gain, 0.0, 0.05);
  EXPECT_GT(measure("contacts/critical_share").error.value, 2.0) << "noise says nothing";
}

TEST_F(Ranking, ReadsEachThresholdAndSaysWhereItFollowsFromFailure) {
  ranked = ranked_measures(groups[0]);
  EXPECT_TRUE(measure("lc/mean").by_own_failure);
  EXPECT_EQ(measure("lc/mean[1]").label, "Mean ℓ_c of the overloaded grains (2 Γ_c)");
  EXPECT_FALSE(measure("contacts/coordination_number").by_own_failure);
  EXPECT_THROW(measure("overloaded/fraction"), std::out_of_range) << "it does not vary";
  for (RunView& run : groups[0].runs) run.analysis.gamma_c = 0.3;
  ranked = ranked_measures(groups[0]);
  EXPECT_FALSE(measure("lc/mean").by_own_failure) << "the same threshold for all beds";
}

TEST_F(Ranking, ComparesABedWithItselfFarFromFailure) {
  ranked = ranked_measures(groups[0]);
  EXPECT_LT(measure("gamma/mean").error.value, 0.6) << "by the ratio: each bed has a scale of its own";
  EXPECT_LT(measure("packing/volume_strain").error.value, 0.6) << "by the difference: it has either sign";
  EXPECT_EQ(measure("packing/volume_strain").beds, 12u);
}

TEST_F(Ranking, IsAFigureOfEightBedsOrMore) {
  const auto figure = ranking_figure(groups);
  ASSERT_TRUE(figure);
  const Table& table = figure->tables.front();
  EXPECT_EQ(table.columns[0].meaning.find("contacts/coordination_number"),
            table.columns[0].meaning.find(": 1 ") + 4);
  EXPECT_EQ(table.columns[1].values.front(), 12.0);
  EXPECT_NE(figure->caption.find("12 runs"), std::string::npos);
  EXPECT_NE(figure->caption.find("set gamma_c"), std::string::npos);
  groups[0].runs.resize(7);
  EXPECT_FALSE(ranking_figure(groups));
}

}  // namespace
}  // namespace talus
