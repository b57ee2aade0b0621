/// Information that the window shows on grains and frames, and visible effects of commands.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "gui/offscreen_fixture.h"
#include "gui/panels.h"
#include "gui/theme.h"

namespace talus {
namespace {

using test::Live;
using test::Replay;

TEST_F(Replay, frames_are_counted_from_0_as_by_the_commands) {
  const auto slider = [this] { return gui::frame_counter(model_.frame_index(), model_.frame_count()); };
  EXPECT_EQ(slider(), "frame 0 (0 to 4)");
  gui_.key(gui::key_end);
  EXPECT_EQ(slider(), "frame 4 (0 to 4)");
  model_.go_to(model_.frame_at_angle("frame3"));
  EXPECT_EQ(slider(), "frame 3 (0 to 4)") << "like talus render --at frame3";
}

/// Counts the pixels of a widget that have the colour of warnings.
int warning_pixels(test::DrivenGui& gui, const char* widget) {
  const render::Image window = gui.frame();
  const gui::WidgetPlace place = gui.place(widget);
  const render::Colour warning = gui::palette_of(view::Theme::light).warning;
  const auto near = [](int one, int other) { return std::abs(one - other) < 40; };
  int count = 0;
  for (int y = static_cast<int>(place.y0); y < static_cast<int>(place.y1); ++y)
    for (int x = static_cast<int>(place.x0); x < static_cast<int>(place.x1); ++x) {
      const std::uint8_t* pixel = window.pixels.data() + 3 * (y * window.width + x);
      if (near(pixel[0], warning.red) && near(pixel[1], warning.green) && near(pixel[2], warning.blue))
        ++count;
    }
  return count;
}

std::string bed_solved_in(int max_iterations) {
  return fmt::format("{}[solver]\nmax_iterations = {}\n", test::small_bed, max_iterations);
}

TEST(Solver, that_misses_its_tolerance_is_a_warning_in_a_replay) {
  const test::TemporaryFolder folder;
  for (const int iterations : {20, 1'000'000}) {
    const std::string run =
        test::take_run(folder, fmt::format("{}.h5", iterations), bed_solved_in(iterations));
    view::ViewModel model = view::ViewModel::open(run, {}, "", false, "");
    test::DrivenGui gui(model, 1400, 900);
    EXPECT_EQ(warning_pixels(gui, "not converged") > 20, iterations == 20) << iterations;
    EXPECT_EQ(model.solved_steps().unconverged > 10, iterations == 20) << iterations;
  }
}

TEST(Solver, that_misses_its_tolerance_is_a_warning_in_a_live_run) {
  const test::TemporaryFolder folder;
  test::write_file(folder, "bed.toml", bed_solved_in(20));
  view::ViewModel model = view::ViewModel::open(folder.path("bed.toml"), {}, "", false, "");
  test::DrivenGui gui(model, 1400, 900);
  EXPECT_EQ(warning_pixels(gui, "not converged"), 0);
  gui.click("deposit");
  EXPECT_TRUE(test::drawn_until(gui, [&] { return model.solved_steps().unconverged > 10; }));
  EXPECT_GT(warning_pixels(gui, "not converged"), 20);
}

TEST_F(Replay, colours_are_reversed_and_clusters_have_palettes) {
  std::optional<render::ColourMap>& colours = model_.state.map.colours;
  gui_.key('m');
  gui_.key('m');
  EXPECT_EQ(colours, render::ColourMap::viridis);
  gui_.click("reversed");
  EXPECT_EQ(colours, render::ColourMap::viridis_r);
  gui_.key('m');
  EXPECT_EQ(colours, render::ColourMap::cividis);
  model_.state.map.layers = {pictures::MapKind::clusters};
  gui_.frame();
  gui_.key('m');
  EXPECT_EQ(model_.state.map.palette, pictures::ClusterPalette::contrast);
  EXPECT_EQ(colours, render::ColourMap::cividis) << "the same for maps with a bar";
  gui_.place("palette");
}

/// Checks the description of each free grain on each map: no NaN, and gamma only on maps that show it.
/// Returns how often a grain that carries nothing was described.
int expect_described_by_maps(test::DrivenGui& gui, view::ViewModel& model) {
  int idle = 0;
  model.state.map.l_min = 0.0;
  for (const pictures::MapKind kind : pictures::map_kinds()) {
    model.state.map.layers = {kind};
    gui.frame();
    for (Index grain = 0; grain < model.statics().free_count; ++grain) {
      const std::string shown_view = gui::grain_text(model.first(), grain);
      const bool loaded = !std::isnan(model.frame().gamma[static_cast<std::size_t>(grain)]);
      idle += loaded ? 0 : 1;
      EXPECT_EQ(shown_view.find("nan"), std::string::npos) << shown_view;
      EXPECT_EQ(shown_view.find("γ = ") != std::string::npos, pictures::shows_gamma(kind) && loaded)
          << pictures::map_name(kind) << ": " << shown_view;
      EXPECT_EQ(shown_view.find("carries nothing") != std::string::npos,
                pictures::shows_gamma(kind) && !loaded)
          << shown_view;
    }
  }
  return idle;
}

TEST_F(Replay, no_grain_is_told_what_the_map_does_not_show) {
  model_.go_to(3);
  expect_described_by_maps(gui_, model_);
}

TEST_F(Live, grains_that_carry_nothing_have_no_number_that_is_none) {
  ASSERT_GT(model_.statics().free_count, 0) << "the first grain, before the first step";
  EXPECT_GT(expect_described_by_maps(gui_, model_), 0);
}

TEST_F(Live, grains_that_are_dropped_are_seen_before_they_fall) {
  gui_.click("deposit");
  ASSERT_TRUE(wait_until([&] { return !status().depositing && !status().running; }));
  const auto highest = [this] {
    double top = 0.0;
    for (std::size_t i = 0; i < model_.frame().y.size(); ++i)
      top = std::max(top, model_.frame().y[i] + model_.statics().radius[i]);
    return top;
  };
  const auto shown_to = [this] {
    const gui::WidgetPlace map = gui_.place("map");
    return model_.first()
        .part(static_cast<double>(map.x1 - map.x0) / static_cast<double>(map.y1 - map.y0))
        .y_max;
  };
  const double before = highest();
  gui_.key('k');
  gui_.click("step 1");
  ASSERT_TRUE(wait_until([&] { return highest() > before + 3.0 * model_.mean_diameter(); }));
  gui_.settle();
  EXPECT_GE(shown_to(), highest()) << "lifted grains are in the picture";
  EXPECT_EQ(model_.state.message,
            fmt::format("Applied after step {}: {}.", model_.live()->commands().back().step,
                        session::command_text(model_.live()->commands().back())));
}

}  // namespace
}  // namespace talus
