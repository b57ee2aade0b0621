/// The time line, interactive plots, and announcements of a run, in a window without a display.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "gui/offscreen_fixture.h"
#include "gui/theme.h"

namespace talus {
namespace {

using test::Live;
using test::Replay;

TEST_F(Replay, the_time_line_goes_where_it_is_clicked) {
  const gui::WidgetPlace line = gui_.place("time line");
  EXPECT_GT(line.x1 - line.x0, 1200.0f);
  gui_.click("time line", 0.76f);
  EXPECT_EQ(model_.frame_index(), 3u);
  gui_.drag("time line", 0.76f, 0.5f, 0.01f, 0.5f);
  EXPECT_EQ(model_.frame_index(), 0u);
  const std::vector<view::TimelineEvent> events(model_.events().begin(), model_.events().end());
  ASSERT_FALSE(events.empty());
  for (const view::TimelineEvent& event : events) {
    model_.go_to(event.frame == 0 ? 2 : 0);
    gui_.click("event " + event.name);
    EXPECT_EQ(model_.frame_index(), event.frame) << event.name;
  }
}

/// Returns a small bed whose tilt follows a programme.
view::ViewModel bed_of_programme(const test::TemporaryFolder& folder, const std::string& program) {
  const std::string run =
      test::take_run(folder, "bed.h5",
                     "seed = 18\n[bed]\nlength = 10\ndepth = 4\n[tilt]\nstep = 0.01\nprogram = " + program +
                         "\n[output]\nframe_every = 0.25\n");
  return view::ViewModel::open(run, {}, "", false, "");
}

TEST(TimeLine, of_a_programme_has_angles_between_its_turns) {
  const test::TemporaryFolder folder;
  view::ViewModel model = bed_of_programme(folder, "['to 1', 'hold 0.5', 'to 0']");
  const test::DrivenGui gui(model, 1400, 900);
  const auto times = [&gui](const char* label) {
    return std::ranges::count(gui.places(), std::string("angle ") + label, &gui::WidgetPlace::name);
  };
  EXPECT_EQ(times("1°"), 2) << "it begins to be held, and falls";
  EXPECT_EQ(times("0.4°"), 2) << "while the tilt grows, and while it falls";
}

TEST(TimeLine, has_one_minus_sign) {
  const test::TemporaryFolder folder;
  view::ViewModel model = bed_of_programme(folder, "['to 0.5', 'to -1']");
  const test::DrivenGui gui(model, 1400, 900);
  EXPECT_TRUE(gui.has("angle −1°")) << "where the programme ends";
  for (const gui::WidgetPlace& place : gui.places())
    EXPECT_FALSE(place.name.starts_with("angle -")) << place.name;
}

TEST_F(Replay, a_plot_answers) {
  gui_.click("plot stress", 0.86f);
  EXPECT_GE(model_.frame_index(), 3u);
  gui_.drag("plot stress", 0.3f, 0.5f, 0.7f, 0.5f);
  EXPECT_GE(model_.frame_index(), 3u) << "a drag does not go to a frame";
  const auto chosen = model_.state.plot_options["stress"].chosen;
  ASSERT_TRUE(chosen.has_value());
  EXPECT_GT((*chosen)[0], 0.0);
  EXPECT_LT((*chosen)[0], (*chosen)[1]);
  EXPECT_LT((*chosen)[1], 1.0);
  gui_.scroll("plot stress", 3.0f);
  const auto zoomed = model_.state.plot_options["stress"].zoomed;
  ASSERT_TRUE(zoomed.has_value());
  EXPECT_LT((*zoomed)[1] - (*zoomed)[0], 0.7);
  gui_.scroll("plot stress", -9.0f);
  EXPECT_FALSE(model_.state.plot_options["stress"].zoomed.has_value());
  gui_.double_click("plot stress", 0.5f);
  EXPECT_FALSE(gui_.has("plot energy"));
  gui_.click("logarithmic");
  EXPECT_EQ(model_.state.plot_options["stress"].log_y, std::optional(true));
  gui_.double_click("plot stress", 0.5f);
  EXPECT_TRUE(gui_.has("plot energy"));
}

/// Counts the pixels in the upper left part of a plot that have the colour of its threshold note.
int note_pixels(test::DrivenGui& gui, const std::string& plot) {
  const render::Image window = gui.frame();
  const gui::WidgetPlace place = gui.place("plot " + plot);
  const render::Colour soft = gui::palette_of(view::Theme::light).soft;
  int count = 0;
  for (int y = static_cast<int>(place.y0); y < static_cast<int>(place.y0 + 0.4f * (place.y1 - place.y0)); ++y)
    for (int x = static_cast<int>(place.x0); x < static_cast<int>(0.5f * (place.x0 + place.x1)); ++x) {
      const std::uint8_t* pixel = window.pixels.data() + 3 * (y * window.width + x);
      const auto near = [](int one, int other) { return std::abs(one - other) < 60; };
      count += near(pixel[0], soft.red) && near(pixel[1], soft.green) && near(pixel[2], soft.blue) ? 1 : 0;
    }
  return count;
}

TEST_F(Replay, plots_of_overloaded_grains_say_their_threshold) {
  for (int wait = 0; wait < 500 && plot_called("lengths").note.empty(); ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    gui_.frame();
  }
  for (const char* plot : {"overloaded", "cluster", "lengths"}) {
    EXPECT_EQ(plot_called(plot).note, "at 1 Γ_c, if θ_c = 20°") << plot;
    EXPECT_GT(note_pixels(gui_, plot), note_pixels(gui_, "stress") + 20) << plot;
  }
  gui_.key(']');
  EXPECT_EQ(plot_called("overloaded").note, "at 1.1 Γ_c, if θ_c = 20°");
}

/// Counts the numbers of the y axis of a plot: the groups of rows with ink to the left of its frame.
int numbers_beside(test::DrivenGui& gui, const std::string& plot) {
  const render::Image window = gui.frame();
  const gui::WidgetPlace place = gui.place("plot " + plot);
  const float em = gui::type_scale[0];
  int count = 0;
  bool before = false;
  for (int y = static_cast<int>(place.y0 + 0.5f * em); y < static_cast<int>(place.y1 - 2.2f * em); ++y) {
    bool ink = false;
    for (int x = static_cast<int>(place.x0 + 1.0f); x < static_cast<int>(place.x0 + 3.2f * em); ++x)
      ink = ink || window.pixels[static_cast<std::size_t>(3 * (y * window.width + x))] < 128;
    count += ink && !before ? 1 : 0;
    before = ink;
  }
  return count;
}

TEST_F(Replay, plots_have_two_numbers_at_least_and_rows_that_are_whole) {
  ASSERT_TRUE(test::drawn_until(gui_, [this] { return model_.all_values_known(); }));
  for (const auto& [width, height] : {std::pair{1280, 800}, {1500, 950}, {1920, 1080}}) {
    gui_.resize(width, height);
    const float end = gui_.place("time line").y0;
    for (const view::Plot& plot : model_.plots()) {
      if (!gui_.has("plot " + plot.name)) continue;
      const gui::WidgetPlace place = gui_.place("plot " + plot.name);
      if (place.y0 >= end - 1.5f * gui::type_scale[0]) continue;  // scrolled to
      EXPECT_LE(place.y1, end) << plot.name << " at " << width;
      EXPECT_GE(numbers_beside(gui_, plot.name), plot.series[0].x.empty() ? 0 : 2) << plot.name << width;
    }
  }
}

TEST_F(Replay, plots_answer_over_time_as_well) {
  gui_.drag("plot stress", 0.3f, 0.5f, 0.7f, 0.5f);
  gui_.click("over time");
  EXPECT_EQ(model_.plot_axis(), view::PlotAxis::time);
  EXPECT_FALSE(model_.state.plot_options["stress"].chosen.has_value()) << "it was chosen in degrees";
  const double begin = *model_.plot_marks().shown;
  gui_.click("plot stress", 0.86f);
  EXPECT_GE(model_.frame_index(), 3u);
  EXPECT_GT(*model_.plot_marks().shown, begin);
  gui_.drag("plot stress", 0.3f, 0.5f, 0.7f, 0.5f);
  const auto chosen = model_.state.plot_options["stress"].chosen;
  ASSERT_TRUE(chosen.has_value());
  EXPECT_GT((*chosen)[0], begin);
  gui_.scroll("plot stress", 3.0f);
  EXPECT_TRUE(model_.state.plot_options["stress"].zoomed.has_value());
  gui_.click("over tilt");
  EXPECT_EQ(model_.plot_axis(), view::PlotAxis::tilt);
}

TEST_F(Replay, what_a_run_does_not_have_is_not_shown_empty) {
  EXPECT_TRUE(gui_.has("plot lengths"));
  model_.state.map.threshold_factor = 4.0;  // no grain is overloaded
  EXPECT_TRUE(test::drawn_until(gui_, [this] { return !gui_.has("plot lengths"); }));
  EXPECT_TRUE(gui_.has("plot stress"));
  EXPECT_FALSE(gui_.has("over angle left")) << "theta_c is unknown";
}

TEST_F(Replay, a_plot_of_another_quantity_is_added_and_removed) {
  gui_.click("add plot");
  gui_.click("quantity filter");
  gui_.type("coordination");
  gui_.click("add plot: contacts/coordination_number");
  ASSERT_EQ(model_.plots().back().name, "contacts/coordination_number");
  EXPECT_FALSE(model_.plots().back().series[0].x.empty());
  gui_.double_click("plot contacts/coordination_number");
  EXPECT_FALSE(gui_.has("plot energy"));
  gui_.click("remove contacts/coordination_number");
  EXPECT_TRUE(gui_.has("plot energy"));
  EXPECT_FALSE(model_.plots().back().added);
}

TEST_F(Replay, plots_are_asked_for_as_figures) {
  gui_.click("export plots");
  gui_.click("plots folder");
  gui_.key('a', true);
  gui_.type("my-plots");
  gui_.click("write plots");
  EXPECT_EQ(gui_.requests().plots_folder, "my-plots");
}

TEST_F(Replay, an_announcement_stays_until_it_is_clicked) {
  EXPECT_FALSE(gui_.has("announcement"));
  model_.state.announcement = "The slope failed at 1.00°.";
  gui_.settle();
  model_.state.message = "something else";
  gui_.settle();
  ASSERT_TRUE(gui_.has("announcement"));
  gui_.click("announcement");
  EXPECT_FALSE(gui_.has("announcement"));
}

TEST_F(Live, is_looked_back_at_while_it_goes_on) {
  EXPECT_FALSE(model_.shows_recorded_frame());
  gui_.click("play");
  ASSERT_TRUE(wait_until([&] { return model_.frame_count() >= 3; }));
  gui_.click("time line", 0.02f);
  EXPECT_TRUE(model_.shows_recorded_frame());
  EXPECT_EQ(model_.frame_index(), 0u);
  gui_.key(gui::key_right);
  EXPECT_EQ(model_.frame_index(), 1u);
  EXPECT_TRUE(model_.shows_recorded_frame());
  gui_.click("follow");
  EXPECT_FALSE(model_.shows_recorded_frame());
  gui_.click("time line", 0.02f);
  gui_.key(gui::key_end);
  EXPECT_FALSE(model_.shows_recorded_frame());
}

}  // namespace
}  // namespace talus
