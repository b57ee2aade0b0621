/// Two views of hand-made runs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "support/temporary_folder.h"
#include "unit/view/example_bed.h"
#include "unit/view/opened_view.h"
#include "view/view_model.h"

namespace talus::view {
namespace {

using example::opened;

/// A run that fails at 20 deg, and another that fails at 12 deg.
class TwoViews : public testing::Test {
 protected:
  TwoViews() : path_(folder_.path("run.h5")), other_(folder_.path("other.h5")) {
    example::write_bed_run(path_, 20.0);
    example::write_bed_run(other_, 12.0);
    model_.emplace(opened(path_));
  }
  double second_tilt() const { return degrees(model_->second_run()->frame().tilt); }

  test::TemporaryFolder folder_;
  std::string path_, other_;
  std::optional<ViewModel> model_;
};

TEST_F(TwoViews, another_map_of_the_same_frame) {
  model_->state.second_view = {.shown = true, .layers = {pictures::MapKind::pressure}};
  model_->go_to(3);
  model_->update(0.0);
  const render::FrameView first = model_->first().map(2.0), second = model_->second().map(2.0);
  EXPECT_EQ(first.discs.size(), second.discs.size());
  EXPECT_EQ(first.x_min, second.x_min);
  EXPECT_EQ(first.y_max, second.y_max);
  EXPECT_NE(model_->first().annotated_map().title, model_->second().annotated_map().title);
  EXPECT_EQ(model_->first().annotated_map().caption, model_->second().annotated_map().caption);
  EXPECT_NE(model_->first().furnished_map().title, model_->second().furnished_map().title);
  EXPECT_EQ(model_->second().values().values.size(), 40u);
  EXPECT_EQ(model_->second_run(), nullptr);
}

TEST_F(TwoViews, a_map_is_not_made_again_where_nothing_has_changed) {
  model_->state.second_view = {.shown = true, .minus = 0.0};
  model_->go_to(3);
  const render::FrameView* first = &model_->first().annotated_map();
  const render::FrameView* second = &model_->second().annotated_map();
  const render::Disc *discs = first->discs.data(), *discs_next_to = second->discs.data();
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(model_->first().annotated_map().discs.data(), discs);
    EXPECT_EQ(model_->second().annotated_map().discs.data(), discs_next_to);
  }
}

TEST_F(TwoViews, a_frame_minus_another_one) {
  model_->state.second_view = {.shown = true, .minus = radians(5.0)};
  model_->go_to(3);
  const GrainValues none = model_->second().values();  // nothing has been drawn yet
  EXPECT_TRUE(none.values.empty());
  EXPECT_NE(model_->second().annotated_map().title.find("15.00° minus 5.00°"), std::string::npos)
      << model_->second().annotated_map().title;
  const std::vector<double>& changes = model_->second().values().values;
  ASSERT_EQ(changes.size(), 40u);
  EXPECT_EQ(changes[0], 0.0) << "overloaded in both";
  EXPECT_NEAR(changes[10], 1.0, 1e-6);
  EXPECT_NEAR(changes[30], 1.0, 1e-6);
  EXPECT_EQ(changes[31], 0.0);
  EXPECT_EQ(model_->second().annotated_map().legends.at(1).swatches.at(0).label, "contacts gained: 0");
  model_->state.second_view.minus = radians(15.0);
  model_->second().annotated_map();
  EXPECT_EQ(std::ranges::max(model_->second().values().values), 0.0) << "minus itself";
}

TEST_F(TwoViews, another_run_at_the_same_tilt) {
  model_->go_to(1);
  model_->open_second_run(other_);
  EXPECT_TRUE(model_->state.second_view.shown);
  EXPECT_NEAR(second_tilt(), 5.0, 1e-6);
  model_->go_to(4);
  EXPECT_TRUE(model_->update(0.0));
  EXPECT_NEAR(second_tilt(), 20.0, 1e-6);
  EXPECT_NE(model_->first().annotated_map().caption, model_->second().annotated_map().caption)
      << "of theta_c";
  model_->close_second_run();
  EXPECT_EQ(model_->second_run(), nullptr);
  EXPECT_EQ(model_->first().annotated_map().caption, model_->second().annotated_map().caption);
}

TEST_F(TwoViews, another_run_as_far_from_failure) {
  model_->go_to(4);
  model_->open_second_run(other_);
  ASSERT_TRUE(model_->has_clock(PlotAxis::angle_left));
  model_->state.second_view.clock = PlotAxis::angle_left;
  model_->update(0.0);
  EXPECT_NEAR(second_tilt(), 10.0, 1e-6) << "0 deg left for 20, and the nearest to 12";
}

TEST_F(TwoViews, the_angle_left_is_no_clock_where_one_has_not_failed) {
  example::write_bed_run(other_, std::nan(""));
  model_->open_second_run(other_);
  EXPECT_FALSE(model_->has_clock(PlotAxis::angle_left));
  EXPECT_TRUE(model_->has_clock(PlotAxis::tilt));
  model_->state.second_view.clock = PlotAxis::angle_left;
  model_->go_to(3);
  model_->update(0.0);
  EXPECT_NEAR(second_tilt(), 0.0, 1e-6) << "stays";
}

TEST_F(TwoViews, of_two_runs_have_one_range_of_colours) {
  model_->open_second_run(other_);
  model_->update(0.0);
  const auto end = [](const render::FrameView& view) {
    return view.legends.at(0).bars.at(0).ticks.back().label;
  };
  EXPECT_EQ(end(model_->first().annotated_map()), end(model_->second().annotated_map()));
  EXPECT_EQ(end(model_->first().annotated_map()), "0.69") << "2 sin 20 deg, the larger of the two";
  model_->state.map.range_low = 0.0;
  model_->state.map.range_high = 0.25;
  model_->update(0.0);
  EXPECT_EQ(end(model_->first().annotated_map()), "0.25");
  EXPECT_EQ(end(model_->second().annotated_map()), "0.25");
  model_->state.second_view.layers = {pictures::MapKind::pressure};
  model_->update(0.0);
  EXPECT_NE(end(model_->second().annotated_map()), "0.25") << "that belongs to another map";
  model_->state.map.range_low = model_->state.map.range_high = std::nullopt;
  model_->update(0.0);
  EXPECT_NE(end(model_->first().annotated_map()), "0.69") << "its own range again";
}

TEST_F(TwoViews, show_the_same_place) {
  model_->open_second_run(other_);
  model_->state.camera = {3.0, 2.0, 2.0};
  model_->update(0.0);
  const render::FrameView first = model_->first().map(2.0), second = model_->second().map(2.0);
  EXPECT_LT(first.x_max - first.x_min, 7.0);
  EXPECT_EQ(first.x_min, second.x_min);
  EXPECT_EQ(first.x_max, second.x_max);
  const Vec2 place = place_in(model_->statics(), model_->second().run.statics(), 4.0, 1.0);
  EXPECT_EQ(place.x, 4.0);
  EXPECT_EQ(place.y, 1.0);
  EXPECT_EQ(find_grain(model_->second().run.bed(), 0.5, 0.5), std::optional<Index>(0));
}

TEST_F(TwoViews, a_selection_is_of_the_first_run) {
  model_->state.selected = 5;
  model_->open_second_run(other_);
  model_->update(0.0);
  EXPECT_EQ(model_->second().run.inspection(), nullptr);
  EXPECT_NE(model_->inspection(), nullptr);
}

TEST_F(TwoViews, what_cannot_be_beside_is_said_and_leaves_what_is_shown) {
  EXPECT_THROW(model_->open_second_run(folder_.path("none.h5")), Error);
  std::ofstream(folder_.path("a.toml")) << "seed = 1\n";
  EXPECT_THROW(model_->open_second_run(folder_.path("a.toml")), Error);
  EXPECT_FALSE(model_->state.second_view.shown);
  EXPECT_EQ(model_->second_run(), nullptr);
  model_->open_second_run(other_);
  EXPECT_THROW(model_->open_second_run(folder_.path("none.h5")), Error);
  EXPECT_NE(model_->second_run(), nullptr) << "the previous one";
}

TEST_F(TwoViews, a_run_that_is_computed_stands_alone) {
  std::ofstream(folder_.path("a.toml")) << "[bed]\nlength = 10\ndepth = 3\n";
  ViewModel live = opened(folder_.path("a.toml"));
  EXPECT_THROW(live.open_second_run(path_), Error);
  live.state.second_view = {.shown = true, .layers = {pictures::MapKind::pressure}, .minus = 0.0};
  EXPECT_FALSE(live.second().annotated_map().title.empty()) << "there is no frame to subtract yet";
}

TEST_F(TwoViews, both_rest_while_another_run_is_opened) {
  model_->open_second_run(other_);
  model_->hold();
  *model_ = opened(other_);
  EXPECT_EQ(model_->second_run(), nullptr);
}

}  // namespace
}  // namespace talus::view
