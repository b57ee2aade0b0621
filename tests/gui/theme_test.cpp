/// Appearance of the window: contrast, themes, and text sizes from small to large windows.

#include "gui/theme.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fmt/core.h>
#include <string_view>
#include <vector>

#include "gui/offscreen_fixture.h"
#include "pictures/cluster_colours.h"
#include "render/png.h"
#include "render/renderer.h"
#include "support/places.h"
#include "view/scene.h"

namespace talus {
namespace {

using test::Replay;

/// Text colour with its background.
struct TextPair {
  std::string_view name;
  render::Colour text, ground;
};

/// Returns all pairs of text and background that occur in a theme.
std::vector<TextPair> text_pairs(const gui::Palette& palette) {
  return {{"text", palette.ink, palette.ground},
          {"text in columns", palette.ink, palette.panel},
          {"buttons", palette.ink, palette.raised},
          {"buttons under the mouse", palette.ink, palette.hovered},
          {"buttons held", palette.ink, palette.pressed},
          {"chosen rows", palette.ink, palette.tint},
          {"hints", palette.soft, palette.ground},
          {"hints in columns", palette.soft, palette.panel},
          {"an announcement", palette.alarm_text, palette.alarm},
          {"a warning", palette.warning, palette.panel},
          {"failure", palette.failure, palette.ground},
          {"command", palette.command, palette.ground},
          {"rearrangement", palette.rearrangement, palette.ground},
          {"second curve", palette.curves[1], palette.ground},
          {"third curve", palette.curves[2], palette.ground},
          {"fourth curve", palette.curves[3], palette.ground}};
}

double linear(std::uint8_t channel) {
  const double share = channel / 255.0;
  return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
}

double luminance(const render::Colour& colour) {
  return 0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) + 0.0722 * linear(colour.blue);
}

/// Returns the contrast of two opaque colours, 1 to 21 (WCAG 2.1, relative luminance).
double contrast(const render::Colour& a, const render::Colour& b) {
  const double one = luminance(a), other = luminance(b);
  return (std::max(one, other) + 0.05) / (std::min(one, other) + 0.05);
}

TEST(Contrast, is_that_of_the_standard) {
  EXPECT_NEAR(contrast(render::black, render::white), 21.0, 1e-9);
  EXPECT_NEAR(contrast({119, 119, 119}, render::white), 4.48, 0.005) << "the usual example that just fails";
  EXPECT_DOUBLE_EQ(contrast({10, 20, 30}, {10, 20, 30}), 1.0);
}

TEST(Contrast, of_all_text_is_enough) {
  for (const std::string_view name : view::theme_names)
    for (const TextPair& pair : text_pairs(gui::palette_of(view::theme_of(name))))
      EXPECT_GE(contrast(pair.text, pair.ground), 4.5) << name << ": " << pair.name;
}

/// Returns the largest contrast to the fill found between the middle and the edge of a disc.
double rim_contrast(render::Renderer& renderer, const render::FrameView& view, const render::Colour& fill,
                    const render::Colour& ground) {
  const render::Image image = renderer.draw(view, 200);
  const int middle = 200 * (image.height / 2) + 100;
  double largest = 1.0;
  for (int x = 0; 2 * x < 200; ++x) {
    const auto* pixel = &image.pixels[static_cast<std::size_t>(image.channels * (middle - x))];
    const double share = image.channels == 4 ? pixel[3] / 255.0 : 1.0;
    const auto over = [&](std::uint8_t channel, std::uint8_t below) {
      return static_cast<std::uint8_t>(share * channel + (1.0 - share) * below);
    };
    if (share < 0.5) break;
    largest = std::max(largest, contrast({over(pixel[0], ground.red), over(pixel[1], ground.green),
                                          over(pixel[2], ground.blue)},
                                         fill));
  }
  return largest;
}

TEST(Contrast, of_the_rims_of_spanning_clusters_is_enough_in_every_theme) {
  render::Renderer renderer(render::make_context(std::nullopt));
  std::vector<render::Colour> fills;
  for (const pictures::ClusterPalette palette : pictures::cluster_palettes)
    fills.push_back(pictures::cluster_palette(palette).front());
  for (const view::Theme theme : {view::Theme::light, view::Theme::dark, view::Theme::print})
    for (const render::Colour& fill : fills)
      for (const double radius : {8.0, 30.0}) {
        render::FrameView view;
        view.furniture = false;
        view.coloured = view.transparent = true;
        view.x_max = 200.0;
        view.y_max = 100.0;
        view.discs.push_back({100.5f, 49.5f, static_cast<float>(radius), fill, render::black, 0.0f});
        if (theme == view::Theme::dark) view = view::on_dark_ground(view);
        const render::Colour shown = view.discs[0].fill;
        EXPECT_GE(rim_contrast(renderer, view, shown, gui::palette_of(theme).ground), 3.0)
            << static_cast<int>(theme) << ", " << int{fill.red} << " " << int{fill.green} << " "
            << int{fill.blue} << ", radius " << radius << " px";
      }
}

TEST(Print, fills_nothing_with_gray) {
  const gui::Palette& palette = gui::palette_of(view::Theme::print);
  for (const render::Colour& fill :
       {palette.ground, palette.panel, palette.raised, palette.track, palette.alarm})
    EXPECT_EQ(fill, render::white);
  for (const render::Colour& text : {palette.ink, palette.soft, palette.line}) EXPECT_EQ(text, render::black);
}

/// Returns whether a source contains a colour literal: IM_COL32(1, 2, 3, 4), ImVec4(0.1f ...), Colour{1, 2,
/// 3}.
bool has_colour(const std::string& text) {
  for (const std::string_view mark : {"IM_COL32(", "ImVec4(", "ImVec4{", "Colour{"})
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) {
      const char next = text[at + mark.size()];
      if (next >= '0' && next <= '9') return true;
    }
  return false;
}

TEST(Theme, is_the_only_place_of_colours) {
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_folder() + "/src/gui")) {
    const std::string name = entry.path().filename().string();
    if (name == "theme.cpp" || name == "theme.h") continue;
    ++read;
    EXPECT_FALSE(has_colour(test::text_of(entry.path()))) << name;
  }
  EXPECT_GT(read, 20);
}

/// Returns the share of the pixels of a picture that are at least as dark as `limit`.
double share_below(const render::Image& image, double limit) {
  int dark = 0;
  for (std::size_t k = 0; k + 2 < image.pixels.size(); k += 3)
    dark += render::luma({image.pixels[k], image.pixels[k + 1], image.pixels[k + 2]}) < limit ? 1 : 0;
  return 3.0 * dark / static_cast<double>(image.pixels.size());
}

TEST_F(Replay, all_of_the_window_follows_the_theme) {
  EXPECT_LT(share_below(gui_.frame(), 80.0), 0.2);
  gui_.key('C');
  EXPECT_EQ(model_.state.theme, view::Theme::dark);
  EXPECT_GT(share_below(gui_.frame(), 80.0), 0.7);
  const render::Image saved = gui_.draw_image(model_.first().furnished_map(), 800);
  EXPECT_GT(saved.pixels[0], 250) << "a saved picture equals that of talus render";
  gui_.key('C');
  const render::Image print = gui_.frame();
  const gui::WidgetPlace play = gui_.place("play");
  const auto x = static_cast<std::size_t>(play.x0 + 3.0f),
             y = static_cast<std::size_t>(0.5f * (play.y0 + play.y1));
  EXPECT_EQ(print.pixels[3 * (y * 1400 + x)], 255) << "a button";
  gui_.key('C');
  EXPECT_EQ(model_.state.theme, view::Theme::light);
}

/// Names of widgets that always exist and never overlap.
const char* const apart[] = {"play", "frame", "map", "time line"};

void expect_apart(const test::DrivenGui& gui, float width, float height, const std::string& at) {
  for (const char* one : apart) {
    if (!gui.has(one)) continue;
    const gui::WidgetPlace a = gui.place(one);
    EXPECT_TRUE(a.x0 >= 0.0f && a.y0 >= 0.0f && a.x1 <= width && a.y1 <= height) << one << " " << at;
    EXPECT_GT(a.x1 - a.x0, 8.0f) << one << " " << at;
    for (const char* other : apart) {
      if (one == other || !gui.has(other)) continue;
      const gui::WidgetPlace b = gui.place(other);
      const bool clear = a.x1 <= b.x0 || b.x1 <= a.x0 || a.y1 <= b.y0 || b.y1 <= a.y0;
      EXPECT_TRUE(clear) << one << " and " << other << " " << at;
    }
  }
}

TEST_F(Replay, nothing_overlaps_from_small_windows_to_large_ones) {
  for (const auto& [width, height] : {std::pair{640, 480}, {1280, 800}, {1920, 1080}, {3840, 2160}})
    for (const double scale : {1.0, 1.5, 2.0, 3.0}) {
      model_.state.scale = scale;
      gui_.resize(width, height);
      expect_apart(gui_, static_cast<float>(width), static_cast<float>(height),
                   fmt::format("at {} x {}, scale {}", width, height, scale));
    }
}

TEST_F(Replay, text_is_no_larger_than_a_small_window_has_room_for) {
  const gui::WidgetPlace usual = gui_.place("play");
  gui_.resize(640, 480);
  model_.state.scale = 3.0;
  gui_.settle();
  EXPECT_NEAR(gui_.place("play").y1 - gui_.place("play").y0, usual.y1 - usual.y0, 1.0f);
  gui_.resize(1920, 1440);
  EXPECT_NEAR(gui_.place("play").y1 - gui_.place("play").y0, 3.0f * (usual.y1 - usual.y0), 4.0f);
}

}  // namespace
}  // namespace talus
