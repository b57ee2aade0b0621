/// Events of a run, from hand-made rows and frames.

#include "view/timeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/trigonometry.h"

namespace talus::view {
namespace {

/// Frames every 5 deg up to 25 and rows every 0.4 deg, ten steps apart. The volume is smallest at 8 deg, the
/// surface has moved by 1 D after 11.2 deg, a cluster spans from 10 deg on, and l_c jumps at 15 deg.
struct ExampleRun {
  std::vector<ObservableRow> rows;
  std::vector<analysis::FrameRecord> values;
  std::vector<Command> commands = {{25, CommandKind::push, 3, 0.1, 0.0}};
  TimelineSource source;

  ExampleRun() {
    for (int k = 0; k <= 62; ++k) {
      ObservableRow& row = rows.emplace_back();
      const double angle = 0.4 * k;
      at(row, Observable::step) = 10.0 * k;
      at(row, Observable::tilt) = radians(angle);
      at(row, Observable::volume_strain) = 0.01 * std::abs(angle - 8.0);
      at(row, Observable::centre_of_mass_strain) = -0.01 * angle;
      at(row, Observable::surface_displacement) = angle > 11.4 ? 2.0 : 0.0;
    }
    for (int k = 0; k <= 5; ++k) {
      source.tilts.push_back(radians(5.0 * k));
      values.push_back({.tilt = radians(5.0 * k),
                        .thresholds = {{.lc_max = k < 3 ? 1.0 + k : 9.0, .spans_depth = k < 2 ? 0 : 1}}});
    }
    source.rows = rows;
    source.values = values;
    source.commands = commands;
    source.command_rows = rows;
    source.theta_c = radians(20.0);
    source.mean_diameter = 2.0;
    source.cut = 100.0;
  }
};

std::vector<std::string> names_of(const std::vector<TimelineEvent>& events) {
  std::vector<std::string> names;
  for (const TimelineEvent& event : events) names.push_back(event.name);
  return names;
}

TEST(PlaceAmong, is_between_two_frames_and_not_beyond_the_ends) {
  const std::vector<double> tilts = {0.0, 1.0, 3.0};
  EXPECT_EQ(place_among(tilts, 1.0), 1.0);
  EXPECT_EQ(place_among(tilts, 1.5), 1.25);
  EXPECT_EQ(place_among(tilts, -1.0), 0.0);
  EXPECT_EQ(place_among(tilts, 9.0), 2.0);
  EXPECT_EQ(place_among({}, 1.0), 0.0);
}

TEST(Timeline, has_what_happened_in_its_order) {
  const ExampleRun run;
  const auto events = timeline_events(run.source);
  ASSERT_EQ(names_of(events), (std::vector<std::string>{"command 0", "dilation", "spans", "percolation",
                                                        "first slide", "length jump", "theta_c"}));
  const double angles[] = {1.0, 8.0, 10.0, 10.0, 11.2, 15.0, 20.0};
  const std::size_t frames[] = {0, 2, 2, 2, 2, 3, 4};
  for (std::size_t k = 0; k < events.size(); ++k) {
    EXPECT_NEAR(degrees(events[k].tilt), angles[k], 1e-9) << events[k].name;
    EXPECT_NEAR(events[k].place, angles[k] / 5.0, 1e-9) << events[k].name;
    EXPECT_EQ(events[k].frame, frames[k]) << events[k].name;
  }
  EXPECT_EQ(events[0].kind, TimelineEvent::Kind::command);
  EXPECT_EQ(events[1].label, "θ_d, volume") << "there are three estimators";
  EXPECT_EQ(events[3].label, "θ_d, clusters");
  EXPECT_NE(events[0].what.find("grain 3"), std::string::npos);
  EXPECT_EQ(events.back().kind, TimelineEvent::Kind::failure);
}

TEST(Timeline, has_the_rearrangements_of_an_analysis_by_their_size) {
  ExampleRun run;
  const std::vector<analysis::EventRecord> events = {
      {.begin = radians(2.5), .energy = 1e-3, .centre_of_mass_strain = -1.0, .grains = 7},
      {.begin = radians(7.5), .energy = 10.0, .centre_of_mass_strain = 1.0},
      {.begin = radians(9.0), .energy = -1.0},
      {.begin = radians(19.9), .kind = 1, .energy = 1e5}};
  run.source.rearrangements = events;
  run.source.energy_unit = 1e-3;
  std::vector<TimelineEvent> found = timeline_events(run.source);
  std::erase_if(found, [](const auto& event) { return event.kind != TimelineEvent::Kind::rearrangement; });
  ASSERT_EQ(names_of(found),
            (std::vector<std::string>{"rearrangement 0", "rearrangement 1", "rearrangement 2"}))
      << "the failure is marked by theta_c";
  EXPECT_NEAR(found[0].size, 0.2, 1e-12) << "four decades below the largest";
  EXPECT_NEAR(found[1].size, 1.0, 1e-12);
  EXPECT_NEAR(found[2].size, 0.2, 1e-12) << "without energy";
  EXPECT_EQ(found[0].what, "rearrangement, 1 m g D, 7 grains moved; the bed contracts");
  EXPECT_NE(found[1].what.find("dilates"), std::string::npos);
  EXPECT_NEAR(found[0].place, 0.5, 1e-12);
}

TEST(Timeline, of_a_run_that_goes_on_has_no_largest_jump_yet) {
  ExampleRun run;
  run.source.may_change = true;
  run.source.theta_c.reset();
  EXPECT_EQ(names_of(timeline_events(run.source)),
            (std::vector<std::string>{"command 0", "dilation", "spans", "first slide"}));
}

/// The same run after the bed has been tilted to 5 deg and back, with 30 additional frames and rows.
TEST(Timeline, of_a_tilt_that_went_up_and_down_is_of_its_last_rise) {
  ExampleRun run;
  std::vector<double> tilts;
  std::vector<ObservableRow> rows;
  std::vector<analysis::FrameRecord> values;
  for (int k = 0; k < 30; ++k) {
    const double tilt = radians(5.0 - std::abs(5.0 - k / 3.0));
    tilts.push_back(tilt);
    values.push_back({.tilt = tilt, .thresholds = {{.lc_max = 1.0, .spans_depth = 0}}});
    ObservableRow row{};
    at(row, Observable::step) = 10.0 * k;
    at(row, Observable::tilt) = tilt;
    rows.push_back(row);
  }
  for (ObservableRow& row : run.rows) at(row, Observable::step) += 300.0;
  rows.insert(rows.end(), run.rows.begin(), run.rows.end());
  for (std::size_t k = 0; k < rows.size(); ++k) at(rows[k], Observable::time) = 0.1 * static_cast<double>(k);
  tilts.insert(tilts.end(), run.source.tilts.begin(), run.source.tilts.end());
  values.insert(values.end(), run.values.begin(), run.values.end());
  run.source.tilts = tilts;
  run.source.rows = rows;
  run.source.values = values;
  for (std::size_t k = 0; k < tilts.size(); ++k)
    run.source.times.push_back(k < 30 ? 0.1 * static_cast<double>(k)
                                      : 3.0 + 1.25 * static_cast<double>(k - 30));
  const std::vector<Command> commands = {{195, CommandKind::push, 3, 0.1, 0.0}};  // while the tilt decreases
  run.source.commands = commands;
  run.source.command_rows = rows;
  const auto events = timeline_events(run.source);
  ASSERT_EQ(names_of(events), (std::vector<std::string>{"command 0", "dilation", "spans", "percolation",
                                                        "first slide", "length jump", "theta_c"}));
  EXPECT_NEAR(events[0].place, 19.5, 1e-9);
  EXPECT_NEAR(degrees(events[0].tilt), 5.0 - 4.5 / 3.0, 1e-9);
  const double angles[] = {8.0, 10.0, 10.0, 11.2, 15.0, 20.0};
  for (std::size_t k = 1; k < events.size(); ++k)
    EXPECT_NEAR(events[k].place, 30.0 + angles[k - 1] / 5.0, 1e-9) << events[k].name;
}

TEST(Timeline, has_what_the_values_known_so_far_tell) {
  ExampleRun run;
  const auto has = [&run](Landmark landmark) {
    return std::ranges::count(names_of(timeline_events(run.source)), text_of(landmark).event) == 1;
  };
  run.source.values = std::span(run.values).first(5);
  EXPECT_FALSE(has(Landmark::length_jump)) << "not all values are known";
  EXPECT_TRUE(has(Landmark::percolation));
  run.source.values = std::span(run.values).first(2);
  EXPECT_FALSE(has(Landmark::percolation));
  run.source.values = run.values;
  EXPECT_TRUE(has(Landmark::length_jump));
  run.source.theta_c = radians(4.0);
  EXPECT_FALSE(has(Landmark::length_jump)) << "up to 4 deg there is only one frame";
  run.source.theta_c = radians(7.0);
  EXPECT_FALSE(has(Landmark::theta_d)) << "up to 7 deg it contracts";
  run.source.theta_c = radians(20.0);
  run.source.rows = {};
  EXPECT_FALSE(has(Landmark::theta_d));
}

TEST(Timeline, is_empty_before_the_first_frame) {
  ExampleRun run;
  run.source.tilts.clear();
  EXPECT_TRUE(timeline_events(run.source).empty());
}

}  // namespace
}  // namespace talus::view
