/// No text of the window is clipped or overlaps another at any size, judged by the rectangles of the letters
/// in the draw data.

#include <gtest/gtest.h>
#include <imgui.h>

#include <fmt/core.h>

#include "gui/imgui_fonts.h"
#include "gui/imgui_versions.h"
#include "gui/offscreen_fixture.h"

namespace talus {
namespace {

using test::Replay;

/// Letter as drawn, with its clip rectangle, px.
struct Letter {
  std::string part;  ///< part of the window
  ImVec4 box, clip;  ///< x0, y0, x1, y1
};

/// Returns the rectangles with the texture of the font whose four corners have different texture coordinates.
std::vector<Letter> letters_of(const ImDrawData& data, ImTextureID font, const ImVec2& white) {
  std::vector<Letter> letters;
  for (int k = 0; k < data.CmdListsCount; ++k) {
    const ImDrawList& list = *data.CmdLists[k];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      if (command.GetTexID() != font) continue;
      for (unsigned int at = command.IdxOffset; at + 6 <= command.IdxOffset + command.ElemCount;) {
        const auto vertex = [&](unsigned int i) -> const ImDrawVert& {
          return list
              .VtxBuffer[static_cast<int>(command.VtxOffset + list.IdxBuffer[static_cast<int>(at + i)])];
        };
        const ImDrawVert &low = vertex(0), &high = vertex(2);
        const bool letter = low.uv.x != white.x && low.uv.x < high.uv.x && low.uv.y < high.uv.y &&
                            vertex(1).pos.y == low.pos.y && vertex(1).pos.x == high.pos.x;
        if (!letter) {
          at += 3;
          continue;
        }
        letters.push_back({list._OwnerName != nullptr ? list._OwnerName : "",
                           {low.pos.x, low.pos.y, high.pos.x, high.pos.y},
                           command.ClipRect});
        at += 6;
      }
    }
  }
  return letters;
}

std::string text_of(const Letter& letter) {
  return fmt::format("{} ({:.0f}, {:.0f})", letter.part, letter.box.x, letter.box.y);
}

/// Returns letters that are clipped at the left or right (outside scrolling parts, on any side), and letters
/// that overlap others.
std::string untidy(const std::vector<Letter>& letters) {
  std::string wrong;
  constexpr float slack = 1.0f;  // px
  std::vector<const Letter*> seen;
  for (const Letter& letter : letters) {
    const ImVec4 &box = letter.box, &clip = letter.clip;
    const bool scrolls = letter.part.find('/') != std::string::npos && !letter.part.starts_with("picture");
    const bool hidden = box.z <= clip.x || box.x >= clip.z || box.w <= clip.y || box.y >= clip.w;
    if (hidden && scrolls) continue;
    if (box.x < clip.x - slack || box.z > clip.z + slack) wrong += text_of(letter) + " is cut at its side\n";
    if (!scrolls && (box.y < clip.y - slack || box.w > clip.w + slack))
      wrong += text_of(letter) + " is cut\n";
    for (const Letter* other : seen) {
      const float x = std::min(box.z, other->box.z) - std::max(box.x, other->box.x);
      const float y = std::min(box.w, other->box.w) - std::max(box.y, other->box.y);
      // The foot of a j may reach below the preceding letter.
      const bool next = other == seen.back() && box.x > other->box.x && x < 0.3f * (box.w - box.y);
      if (!next && x > 1.5f && y > 1.5f) wrong += text_of(letter) + " meets " + text_of(*other) + "\n";
    }
    seen.push_back(&letter);
  }
  return wrong.substr(0, 400);
}

class TidyWindow : public Replay {
 protected:
  /// px, lower end of the map with its legend
  float below() const { return gui_.place(gui_.has("border") ? "border" : "time line").y0; }

  void expect_tidy(const std::string& what) {
    gui_.frame();
    const ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    const std::vector<Letter> letters =
        letters_of(*ImGui::GetDrawData(), test::font_texture(fonts), fonts.TexUvWhitePixel);
    EXPECT_GT(letters.size(), 100u) << what << ": every layout has this much text";
    EXPECT_EQ(untidy(letters), "") << what;
  }
};

TEST_F(TidyWindow, at_every_size_and_scale) {
  for (const double scale : {1.0, 2.0})
    for (const auto& [width, height] : {std::pair{1280, 800}, {2560, 1440}, {800, 600}, {640, 450}}) {
      model_.state.scale = scale;
      gui_.resize(width, height);
      for (const char* map : {"gamma", "clusters+forces", "coarse+forces", "dyed", "displacement", "cells"}) {
        model_.state.map.layers = pictures::map_layers(map);
        expect_tidy(fmt::format("{}, {} x {} at scale {}", map, width, height, scale));
        EXPECT_TRUE(gui_.has("time line")) << width << " at " << scale;
        for (const render::Legend& legend : model_.first().annotated_map().legends)
          for (const render::Swatch& swatch : legend.swatches)
            EXPECT_LE(gui_.place("swatch " + swatch.label).y1, below()) << swatch.label;
      }
    }
}

TEST_F(TidyWindow, with_two_views) {
  model_.go_to(3);
  model_.state.second_view.shown = true;
  for (const double scale : {1.0, 1.5, 2.0})
    for (const auto& [width, height] : {std::pair{1280, 800}, {2560, 1440}, {900, 1400}}) {
      model_.state.scale = scale;
      gui_.resize(width, height);
      for (const bool minus : {false, true})
        for (const char* map : {"coarse+forces", "clusters+displacement"}) {
          model_.state.second_view.minus = minus ? std::optional(0.005) : std::nullopt;
          model_.state.map.layers = pictures::map_layers(map);
          expect_tidy(fmt::format("{}, {} x {} at scale {}", map, width, height, scale));
        }
    }
}

}  // namespace
}  // namespace talus
