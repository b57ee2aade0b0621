/// Tables behind the figure of rearrangements, from hand-made events.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/trigonometry.h"
#include "figures/recipes.h"
#include "runs/event_catalogue.h"
#include "unit/figures/example_figure_run.h"

namespace talus::figures {
namespace {

const std::vector<double>& column(const Table& table, const std::string& name) {
  for (const Column& each : table.columns)
    if (each.name == name) return each.values;
  throw std::out_of_range(name);
}

const Table& table_called(const Figure& figure, const std::string& beginning) {
  for (const Table& table : figure.tables)
    if (table.name.starts_with(beginning)) return table;
  throw std::out_of_range(beginning);
}

class EventFigure : public ::testing::Test {
 protected:
  EventFigure() {
    example::store_with_commits(path_, 4);
    groups_.resize(1);
    groups_[0].label = "PBC";
    for (const std::uint64_t seed : {1, 2}) groups_[0].runs.push_back(example::figure_run(path_, seed, 80.0));
  }

  /// Adds `count` events of 1, 2, 4, ... m g D to each run; the last is the failure.
  void add_events(int count) {
    for (runs::RunView& run : groups_[0].runs) {
      const RunStatics& statics = run.file->header().statics;
      const double unit = runs::mean_grain_mass(statics) * statics.gravity * statics.mean_diameter;
      for (int k = 0; k < count; ++k)
        run.analysis.events.push_back({.begin = radians(1.0 + k),
                                       .waiting = k == 0 ? not_known : radians(0.1 * k),
                                       .kind = k + 1 == count ? 1 : 0,
                                       .energy = unit * std::pow(2.0, k),
                                       .centre_of_mass_strain = 1e-6 * (k - 2)});
    }
  }

  example::TemporaryFolder folder_;
  std::string path_ = folder_.path("run.h5");
  std::vector<RunGroup> groups_;
};

TEST_F(EventFigure, takes_the_runs_of_a_group_together) {
  add_events(7);
  const Figure figure = event_figure(groups_).value();
  const Table& events = figure.tables.front();
  EXPECT_EQ(column(events, "theta").size(), 12u) << "six from each of two runs, without the failure";
  EXPECT_NEAR(column(events, "theta")[1], 2.0, 1e-12);
  EXPECT_EQ(column(events, "seed")[6], 2.0);
  EXPECT_NEAR(column(events, "energy")[3], 8.0, 1e-9);
  EXPECT_NEAR(column(events, "centre_of_mass_strain")[0], -2.0, 1e-9);
}

TEST_F(EventFigure, has_shares_and_laws) {
  add_events(7);
  const Figure figure = event_figure(groups_).value();
  const Table& sizes = table_called(figure, "sizes-");
  const auto& energy = column(sizes, "energy");
  const auto& share = column(sizes, "share");
  EXPECT_TRUE(std::ranges::is_sorted(energy));
  EXPECT_EQ(share.front(), 1.0);
  EXPECT_NEAR(share.back(), 1.0 / 12.0, 1e-12);
  const auto& law = column(sizes, "power_law");
  const auto first = std::ranges::find_if(law, [](double value) { return !std::isnan(value); });
  ASSERT_NE(first, law.end());
  EXPECT_NEAR(*first, share[static_cast<std::size_t>(first - law.begin())], 1e-12)
      << "it begins on the curve";
  EXPECT_LT(law.back(), *first);
  const Table& waits = table_called(figure, "waits-");
  EXPECT_EQ(column(waits, "waiting").size(), 10u) << "the first event of a run has no waiting angle";
  EXPECT_NEAR(column(waits, "exponential_law").front(), 1.0, 1e-12);
  // Waiting angles from 0.1 to 0.5 deg exceed the shortest by 0.2 on average.
  EXPECT_NEAR(column(waits, "exponential_law").back(), std::exp(-0.4 / 0.2), 1e-9);
}

TEST_F(EventFigure, says_where_there_are_too_few_for_a_law) {
  add_events(3);
  const Figure figure = event_figure(groups_).value();
  for (const double value : column(table_called(figure, "sizes-"), "power_law"))
    EXPECT_TRUE(std::isnan(value));
  const auto text =
      std::ranges::find(figure.variables, "size_law_1", [](const auto& pair) { return pair.first; });
  ASSERT_NE(text, figure.variables.end());
  EXPECT_EQ(text->second, "\"too few for a law: 4\"");
}

// gnuplot rejects an empty range, and a table without values.
TEST_F(EventFigure, has_axes_with_room_for_a_single_rearrangement) {
  groups_[0].runs.resize(1);
  add_events(2);
  const Figure figure = event_figure(groups_).value();
  const auto value = [&figure](const char* name) {
    const auto found = std::ranges::find(figure.variables, name, [](const auto& pair) { return pair.first; });
    EXPECT_NE(found, figure.variables.end()) << name;
    return std::stod(found->second);
  };
  EXPECT_NEAR(value("energy_from"), 0.25, 1e-6);
  EXPECT_NEAR(value("energy_to"), 4.0, 1e-6);
  EXPECT_LT(value("waiting_from"), value("waiting_to"));
  EXPECT_EQ(column(table_called(figure, "waits-"), "waiting").size(), 1U);
}

TEST_F(EventFigure, is_none_without_rearrangements) {
  EXPECT_FALSE(event_figure(groups_).has_value());
  add_events(1);
  EXPECT_FALSE(event_figure(groups_).has_value()) << "only a failure";
}

}  // namespace
}  // namespace talus::figures
