/// Two views of a hand-made run.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "core/trigonometry.h"
#include "unit/view/opened_view.h"
#include "view/view_model.h"

namespace talus::view {
namespace {

using TwoViews = example::ViewOfBed;

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
  EXPECT_EQ(model_->second().bar()->values.size(), 40u);
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
  EXPECT_NE(model_->second().annotated_map().title.find("15.00° minus 5.00°"), std::string::npos)
      << model_->second().annotated_map().title;
  const std::vector<double> changes = model_->second().bar()->values;
  ASSERT_EQ(changes.size(), 40u);
  EXPECT_EQ(changes[0], 0.0) << "overloaded in both";
  EXPECT_NEAR(changes[10], 1.0, 1e-6);
  EXPECT_NEAR(changes[30], 1.0, 1e-6);
  EXPECT_EQ(changes[31], 0.0);
  EXPECT_EQ(model_->second().annotated_map().legends.at(1).swatches.at(0).label, "contacts gained: 0");
  model_->state.second_view.minus = radians(15.0);
  EXPECT_EQ(std::ranges::max(model_->second().bar()->values), 0.0) << "minus itself";
}

TEST_F(TwoViews, a_range_belongs_to_its_map) {
  const auto end = [](const render::FrameView& view) {
    return view.legends.at(0).bars.at(0).ticks.back().label;
  };
  model_->state.map.range_low = 0.0;
  model_->state.map.range_high = 0.25;
  EXPECT_EQ(end(model_->first().annotated_map()), "0.25");
  EXPECT_EQ(end(model_->second().annotated_map()), "0.25") << "the same map";
  model_->state.second_view.layers = {pictures::MapKind::pressure};
  EXPECT_NE(end(model_->second().annotated_map()), "0.25") << "that belongs to another map";
}

TEST_F(TwoViews, a_run_that_is_computed_has_them_too) {
  std::ofstream(folder_.path("a.toml")) << "[bed]\nlength = 10\ndepth = 3\n";
  ViewModel live = example::opened(folder_.path("a.toml"));
  live.state.second_view = {.shown = true, .layers = {pictures::MapKind::pressure}, .minus = 0.0};
  EXPECT_FALSE(live.second().annotated_map().title.empty()) << "there is no frame to subtract yet";
}

}  // namespace
}  // namespace talus::view
