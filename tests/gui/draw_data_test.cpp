/// Rendering of ImGui's layout: positions, colours, clipping, textures, and orientation of rows.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>

#include "gui/imgui_fonts.h"
#include "gui/screen.h"
#include "gui/theme.h"
#include "render/font.h"

namespace talus {
namespace {

constexpr int width = 40, height = 20;

using Pixel = std::array<int, 3>;
constexpr Pixel white_pixel{255, 255, 255}, red{255, 0, 0}, black_pixel{0, 0, 0};

/// Context, ImGui without widgets, and a surface of 40 x 20 px.
class DrawData : public testing::Test {
 protected:
  DrawData() : context_(render::make_context(std::nullopt)), gl_(render::load_gl(*context_)) {
    painter_ = std::make_unique<gui::DrawDataPainter>(gl_);
    imgui_ = ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().DisplaySize = {width, height};
    ImGui::GetStyle().Colors[ImGuiCol_WindowBg] = {1.0f, 1.0f, 1.0f, 1.0f};  // background
    ImGui::GetIO().Fonts->Build();
    const std::uint8_t full = 255;
    plain_ = render::make_texture(gl_, 1, 1, 1, &full, GL_NEAREST);
    gui::widen(gl_, plain_, gui::OneChannel::alpha);
    texture_ = render::make_texture(gl_, 2 * width, 2 * height, 4, nullptr, GL_NEAREST);
    gl_.GenFramebuffers(1, &surface_.framebuffer);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, surface_.framebuffer);
    gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
    surface_.width = width;
    surface_.height = height;
    surface_.top_row_first = true;
    ImGui::NewFrame();
    list()->PushTextureID(gui::texture_id(plain_));
  }
  ~DrawData() override {
    ImGui::DestroyContext(imgui_);
    painter_.reset();
  }

  static ImDrawList* list() { return ImGui::GetForegroundDrawList(); }

  /// Adds two triangles that show an entire texture.
  static void add_picture(GLuint texture, ImVec2 low, ImVec2 high) {
    list()->AddImage(gui::texture_id(texture), low, high);
  }
  /// Adds a rectangle without soft edges.
  static void add_rectangle(ImVec2 low, ImVec2 high, ImU32 colour) {
    list()->PrimReserve(6, 4);
    list()->PrimRectUV(low, high, {0.5f, 0.5f}, {0.5f, 0.5f}, colour);
  }

  void draw() {
    ImGui::Render();
    painter_->draw(*ImGui::GetDrawData(), surface_);
    pixels_.resize(static_cast<std::size_t>(3 * surface_.width * surface_.height));
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl_.ReadPixels(0, 0, surface_.width, surface_.height, GL_RGB, GL_UNSIGNED_BYTE, pixels_.data());
    EXPECT_EQ(gl_.GetError(), static_cast<GLenum>(GL_NO_ERROR));
  }
  /// Returns the pixel in column x and row y of the surface.
  Pixel at(int x, int y) const {
    const std::uint8_t* p = pixels_.data() + 3 * (y * surface_.width + x);
    return {p[0], p[1], p[2]};
  }

  std::unique_ptr<render::Context> context_;
  render::Gl gl_;
  std::unique_ptr<gui::DrawDataPainter> painter_;
  ImGuiContext* imgui_ = nullptr;
  GLuint plain_ = 0, texture_ = 0;
  gui::Surface surface_;
  std::vector<std::uint8_t> pixels_;
};

TEST_F(DrawData, fills_what_lies_inside) {
  add_rectangle({4, 2}, {12, 7}, IM_COL32(255, 0, 0, 255));
  draw();
  EXPECT_EQ(at(4, 2), red);
  EXPECT_EQ(at(11, 6), red);
  for (const auto& [x, y] : {std::pair{3, 4}, {12, 4}, {6, 1}, {6, 7}, {6, 13}})
    EXPECT_EQ(at(x, y), white_pixel);
}

TEST_F(DrawData, a_window_has_its_top_in_the_last_row) {
  surface_.top_row_first = false;
  list()->PushClipRect({5, 0}, {40, 5});
  add_rectangle({4, 2}, {12, 7}, IM_COL32(255, 0, 0, 255));
  list()->PopClipRect();
  draw();
  EXPECT_EQ(at(5, height - 1 - 2), red);
  EXPECT_EQ(at(11, height - 1 - 4), red);
  EXPECT_EQ(at(6, height - 1 - 1), white_pixel);
  EXPECT_EQ(at(6, height - 1 - 5), white_pixel) << "clipped below";
  EXPECT_EQ(at(4, height - 1 - 3), white_pixel) << "clipped on the left";
}

TEST_F(DrawData, clips) {
  list()->PushClipRect({5, 3}, {7, 5});
  add_rectangle({4, 2}, {12, 7}, IM_COL32(255, 0, 0, 255));
  list()->PopClipRect();
  add_rectangle({20, 10}, {22, 12}, IM_COL32(0, 0, 0, 255));
  draw();
  EXPECT_EQ(at(5, 3), red);
  EXPECT_EQ(at(6, 4), red);
  for (const auto& [x, y] : {std::pair{4, 3}, {7, 3}, {5, 2}, {5, 5}}) EXPECT_EQ(at(x, y), white_pixel);
  EXPECT_EQ(at(21, 11), black_pixel) << "the previous clip rectangle is restored";
}

TEST_F(DrawData, mixes_by_straight_alpha) {
  add_rectangle({0, 0}, {10, 10}, IM_COL32(0, 0, 0, 255));
  add_rectangle({0, 0}, {20, 10}, IM_COL32(255, 0, 0, 128));
  draw();
  EXPECT_EQ(at(5, 5), (Pixel{128, 0, 0}));
  EXPECT_EQ(at(15, 5), (Pixel{255, 127, 127}));
}

TEST_F(DrawData, shows_one_channel_as_gray) {
  const std::array<std::uint8_t, 4> rows = {0, 0, 100, 100};  // dark at the top, lighter below
  const GLuint picture = render::make_texture(gl_, 2, 2, 1, rows.data(), GL_NEAREST);
  gui::widen(gl_, picture, gui::OneChannel::gray);
  add_picture(picture, {10, 4}, {14, 8});
  draw();
  EXPECT_EQ(at(11, 5), black_pixel) << "row 0 is the top";
  EXPECT_EQ(at(12, 6), (Pixel{100, 100, 100}));
}

TEST_F(DrawData, shows_one_channel_as_alpha) {
  const std::uint8_t half = 128;
  const GLuint glyph = render::make_texture(gl_, 1, 1, 1, &half, GL_NEAREST);
  gui::widen(gl_, glyph, gui::OneChannel::alpha);
  list()->AddImage(gui::texture_id(glyph), {10, 4}, {14, 8}, {0, 0}, {1, 1}, IM_COL32(255, 0, 0, 255));
  draw();
  EXPECT_EQ(at(11, 5), (Pixel{255, 127, 127})) << "red ink, half covered";
}

TEST_F(DrawData, shows_a_picture_in_its_colours) {
  const std::array<std::uint8_t, 8> colours = {255, 0, 0, 255, 10, 20, 30, 255};
  const GLuint picture = render::make_texture(gl_, 2, 1, 4, colours.data(), GL_NEAREST);
  add_picture(picture, {10, 4}, {14, 8});
  draw();
  EXPECT_EQ(at(11, 5), red);
  EXPECT_EQ(at(12, 5), (Pixel{10, 20, 30}));
}

TEST_F(DrawData, a_finer_surface_has_the_same_picture_larger) {
  surface_.width *= 2;
  surface_.height *= 2;
  ImGui::EndFrame();
  ImGui::GetIO().DisplayFramebufferScale = {2.0f, 2.0f};
  ImGui::NewFrame();
  list()->PushTextureID(gui::texture_id(plain_));
  list()->PushClipRect({0, 0}, {11, 20});
  add_rectangle({4, 2}, {12, 7}, IM_COL32(255, 0, 0, 255));
  list()->PopClipRect();
  draw();
  EXPECT_EQ(at(8, 4), red);
  EXPECT_EQ(at(21, 13), red);
  for (const auto& [x, y] : {std::pair{7, 8}, {22, 8}, {12, 3}, {12, 14}}) EXPECT_EQ(at(x, y), white_pixel);
}

TEST_F(DrawData, shows_a_gray_map_as_gray) {
  render::FrameView view;
  view.x_max = view.y_max = 1.0;
  view.furniture = false;
  view.discs.push_back({0.5f, 0.5f, 5.0f, render::gray(0.6), render::gray(0.6), 0.0f});
  gui::MapTexture map(std::move(context_), gl_);
  for (const auto& [shade, level] : {std::pair{0.6, 102}, {0.2, 204}, {0.2, 204}}) {
    view.discs[0].fill = render::gray(shade);
    add_picture(map.draw(view, 200), {10, 4}, {14, 8});
    draw();
    EXPECT_EQ(at(12, 6), (Pixel{level, level, level}));
    ImGui::NewFrame();
  }
  painter_.reset();  // destroyed before its context
}

/// Draw lists of several commands, each with its own vertex numbering.
TEST_F(DrawData, draws_more_corners_than_16_bits_count) {
  ImGui::EndFrame();
  ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  ImGui::NewFrame();
  list()->PushTextureID(gui::texture_id(plain_));
  for (int k = 0; k < 20000; ++k) add_rectangle({0, 0}, {4, 4}, IM_COL32(0, 0, 0, 255));
  add_rectangle({10, 10}, {14, 14}, IM_COL32(255, 0, 0, 255));
  draw();
  EXPECT_GT(list()->CmdBuffer.Size, 1);
  EXPECT_EQ(at(2, 2), black_pixel);
  EXPECT_EQ(at(12, 12), red);
  EXPECT_EQ(at(6, 6), white_pixel);
}

TEST(GuiFont, has_what_pictures_say) {
  ImFontAtlas atlas;
  gui::add_embedded_font(atlas, 1.0f);
  ImFont& font = *atlas.Fonts[0];
  EXPECT_EQ(test::font_size(font), gui::type_scale[0]);
  for (const char32_t code : render::font_code_points())
    EXPECT_TRUE(test::has_letter(font, static_cast<ImWchar>(code))) << std::hex << unsigned{code};
}

TEST(GuiFont, grows_with_the_display) {
  ImFontAtlas atlas;
  gui::add_embedded_font(atlas, 2.0f);
  ASSERT_EQ(atlas.Fonts.Size, 3);
  EXPECT_EQ(test::font_size(*atlas.Fonts[0]), 2.0f * gui::type_scale[0]);
  EXPECT_LT(test::font_size(*atlas.Fonts[1]), test::font_size(*atlas.Fonts[0]));
  EXPECT_GT(test::font_size(*atlas.Fonts[2]), test::font_size(*atlas.Fonts[0]));
}

}  // namespace
}  // namespace talus
