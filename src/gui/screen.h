#pragma once
/// What a window and a picture without a display share: an ImGui context with its font, its drawing, and its
/// input.

#include <memory>
#include <vector>

#include "gui/draw_data.h"
#include "gui/gui.h"
#include "gui/input.h"
#include "render/context.h"
#include "render/image.h"

struct ImGuiContext;

namespace talus::gui {

class MapTexture;

class GuiScreen {
 public:
  /// For a current context. `scale` is that of the display: 2 draws everything twice as large, where the
  /// model asks for no other.
  GuiScreen(std::unique_ptr<render::Context> context, float scale);
  ~GuiScreen();
  GuiScreen(const GuiScreen&) = delete;
  GuiScreen& operator=(const GuiScreen&) = delete;

  /// One picture of the whole window, `seconds` after the one before. `width` and `height` are those in which
  /// mouse positions are given; the surface may have more pixels.
  GuiRequests draw(view::ViewModel& model, const Surface& surface, int width, int height, double seconds);

  /// The window is on another display.
  void set_display_scale(float scale) { display_scale_ = scale; }

  InputQueue& input() { return input_; }
  ImGuiIO& io();
  /// The places of the widgets in the last picture.
  const std::vector<WidgetPlace>& places() const { return places_; }
  /// A view as talus render draws it.
  render::Image draw_image(const render::FrameView& view, int width);
  const render::Gl& gl() const { return gl_; }

 private:
  struct ContextDeleter {
    void operator()(ImGuiContext* context) const;
  };

  /// What fonts and style were made for.
  struct Look {
    view::Theme theme = view::Theme::light;
    float scale = 0.0f;     ///< of text and widgets
    float fineness = 1.0f;  ///< px of the surface in one of the window
    bool operator==(const Look&) const = default;
  };
  void put_on(const Look& look);

  const render::Context* context_;  ///< of map_
  render::Gl gl_;
  std::unique_ptr<MapTexture> map_;         ///< owns the OpenGL context: destroyed last
  std::unique_ptr<MapTexture> map_beside_;  ///< of the second view; null before it is first shown
  std::unique_ptr<DrawDataPainter> painter_;
  std::unique_ptr<ImGuiContext, ContextDeleter> imgui_;
  GLuint font_texture_ = 0;
  float display_scale_ = 1.0f;
  Look look_;
  InputQueue input_;
  std::vector<WidgetPlace> places_;
};

}  // namespace talus::gui
