#include <gtest/gtest.h>

#include <cmath>

#include "core/trigonometry.h"
#include "figures/recipes.h"
#include "unit/io/example_run.h"

namespace talus::figures {
namespace {

const double nan = std::nan("");
constexpr double diameter = 0.01, gravity = 9.81;  // values of the example's header

ObservableRow row_at(double time, double tilt, double displacement) {
  ObservableRow row{};
  at(row, Observable::time) = time;
  at(row, Observable::tilt) = radians(tilt);
  at(row, Observable::surface_displacement) = displacement;
  return row;
}

/// Returns a run that fails at 10 s and 20 deg, and comes to rest at `rest` (deg).
runs::RunView run_with(const std::string& path, double rest, std::uint64_t seed) {
  io::RunStore store = io::RunStore::create(path, example::header(), false);
  io::Segment segment;
  segment.observables = {row_at(7.5, 19.0, 0.0),   row_at(9.0, 19.5, 0.0),    row_at(10.0, 20.0, 0.01),
                         row_at(10.5, 19.8, 0.06), row_at(11.0, 19.6, 0.061), row_at(11.0, 19.6, 0.061)};
  io::Checkpoint checkpoint = example::checkpoint(0);
  checkpoint.results = {{"theta_c", radians(19.9)}, {"theta_r", radians(rest)}};
  for (std::size_t k = 0; k < segment.observables.size(); ++k)
    at(segment.observables[k], Observable::step) = static_cast<double>(k);
  checkpoint.world.step = 5;
  checkpoint.integers = {{"flow_steps", 3}};
  store.commit(segment, checkpoint);
  runs::RunView run = runs::view_of_run(path, io::RunFile::open(path), {});
  run.scenario.seed = seed;
  analysis::Analysis& analysis = run.analysis;
  analysis.theta_c = radians(19.9);
  analysis.thresholds = {
      {.factor = 1.0, .lc_jump = radians(12.0), .lc_jump_error = radians(0.25), .percolation = radians(0.0)},
      {.factor = 2.0, .lc_jump = radians(13.0), .lc_jump_error = radians(0.5)}};
  analysis.dilation = {radians(14.0), radians(15.0)};
  analysis.dilation_low = {radians(11.0), radians(14.5)};
  analysis.dilation_high = {radians(16.0), radians(17.0)};
  return run;
}

double value(const Table& table, const std::string& name, std::size_t row) {
  for (const Column& column : table.columns)
    if (column.name == name) return column.values.at(row);
  throw std::out_of_range(name);
}

class DynamicAngle : public ::testing::Test {
 protected:
  test::TemporaryFolder folder;
  std::vector<RunGroup> groups{1};

  void add(double rest) {
    auto& runs = groups[0].runs;
    runs.push_back(run_with(folder.path("run-" + std::to_string(runs.size()) + ".h5"), rest, runs.size()));
  }
};

TEST_F(DynamicAngle, IsOfRunsWhoseFlowHasStopped) {
  add(nan);
  EXPECT_FALSE(dynamic_angle_figure(groups));
  add(15.3);
  const auto figure = dynamic_angle_figure(groups);
  ASSERT_TRUE(figure);
  EXPECT_EQ(figure->runs, std::vector{groups[0].runs[1].path});
  ASSERT_EQ(figure->tables.size(), 2u);
  EXPECT_EQ(figure->tables[1].name, "trace");
}

TEST_F(DynamicAngle, HasEachEstimateWithItsRange) {
  add(15.3);
  const Table table = dynamic_angle_figure(groups)->tables[0];
  const std::pair<const char*, double> expected[] = {{"seed", 0.0},
                                                     {"theta_r", 15.3},
                                                     {"theta_c", 19.9},
                                                     {"lc_jump_1", 12.0},
                                                     {"lc_jump_1_low", 11.75},
                                                     {"lc_jump_1_high", 12.0},
                                                     {"lc_jump_2", 13.0},
                                                     {"lc_jump_2_low", 12.5},
                                                     {"percolation_1", 0.0},
                                                     {"percolation_1_low", 0.0},
                                                     {"dilation_volume", 14.0},
                                                     {"dilation_volume_low", 11.0},
                                                     {"dilation_volume_high", 16.0},
                                                     {"dilation_centre", 15.0},
                                                     {"dilation_centre_high", 17.0}};
  for (const auto& [name, number] : expected) EXPECT_NEAR(value(table, name, 0), number, 1e-12) << name;
  EXPECT_TRUE(std::isnan(value(table, "percolation_2", 0)));
}

TEST_F(DynamicAngle, ShowsAllAnglesAtRest) {
  add(15.3);
  add(17.1);
  const auto figure = dynamic_angle_figure(groups);
  const auto variable = [&figure](const std::string& name) {
    for (const auto& [key, text] : figure->variables)
      if (key == name) return text;
    return std::string();
  };
  EXPECT_EQ(variable("lowest"), "14");
  EXPECT_EQ(variable("highest"), "19");
  EXPECT_EQ(variable("factors"), "\"1 2\"");
}

TEST_F(DynamicAngle, TracesTheSurfaceFromTwoSecondsBeforeFailureOn) {
  add(15.3);
  const Table trace = flow_trace(groups[0].runs[0]);
  ASSERT_EQ(trace.columns[0].values.size(), 4u) << "one row per interval";
  const double unit = std::sqrt(gravity * diameter);
  const double expected[][3] = {{-1.0, 19.5, 0.0}, {0.0, 20.0, 0.01}, {0.5, 19.8, 0.1}, {1.0, 19.6, 0.002}};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(value(trace, "time", k), expected[k][0], 1e-12);
    EXPECT_NEAR(value(trace, "theta", k), expected[k][1], 1e-12);
    EXPECT_NEAR(value(trace, "velocity", k), expected[k][2] / unit, 1e-12);
  }
}

}  // namespace
}  // namespace talus::figures
