#pragma once
/// Common part of the window and the picture without a display: an ImGui context with its font, drawing and
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
  /// Requires a current context. `scale` is that of the display: with 2 everything is twice as large, unless
  /// the model requests another scale.
  GuiScreen(std::unique_ptr<render::Context> context, float scale);
  ~GuiScreen();
  GuiScreen(const GuiScreen&) = delete;
  GuiScreen& operator=(const GuiScreen&) = delete;

  /// Draws one picture of the entire window, `seconds` after the previous one. Mouse positions are given in
  /// `width` x `height`; the surface may have more pixels.
  GuiRequests draw(view::ViewModel& model, const Surface& surface, int width, int height, double seconds);

  /// Sets the scale when the window moves to another display.
  void set_display_scale(float scale) { display_scale_ = scale; }

  InputQueue& input() { return input_; }
  ImGuiIO& io();
  /// Returns the places of the widgets in the last picture.
  const std::vector<WidgetPlace>& places() const { return places_; }
  /// Draws a view as talus render does.
  render::Image draw_image(const render::FrameView& view, int width);
  const render::Gl& gl() const { return gl_; }

 private:
  struct ContextDeleter {
    void operator()(ImGuiContext* context) const;
  };

  /// Parameters of the current fonts and style.
  struct Appearance {
    view::Theme theme = view::Theme::light;
    float scale = 0.0f;     ///< scale of text and widgets
    float fineness = 1.0f;  ///< px of the surface per px of the window
    bool operator==(const Appearance&) const = default;
  };
  void apply_appearance(const Appearance& appearance);

  const render::Context* context_;  ///< context of map_
  render::Gl gl_;
  std::unique_ptr<MapTexture> map_;            ///< owns the OpenGL context, therefore destroyed last
  std::unique_ptr<MapTexture> map_of_second_;  ///< map of the second view; null until it is first shown
  std::unique_ptr<DrawDataPainter> painter_;
  std::unique_ptr<ImGuiContext, ContextDeleter> imgui_;
  GLuint font_texture_ = 0;
  float display_scale_ = 1.0f;
  Appearance appearance_;
  InputQueue input_;
  std::vector<WidgetPlace> places_;
};

}  // namespace talus::gui
