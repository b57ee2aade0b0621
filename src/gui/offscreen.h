#pragma once
/// The entire window without a display, drawn as a picture for documents and tests.

#include <memory>
#include <optional>
#include <vector>

#include "gui/screen.h"

namespace talus::gui {

class OffscreenGui {
 public:
  /// Creates a window of that size (px) in a context without a display, with text and widgets enlarged by
  /// `scale`. Throws Error(unavailable) if there is no context.
  OffscreenGui(view::ViewModel& model, int width, int height, float scale = 1.0f,
               std::optional<render::ContextKind> kind = std::nullopt);
  ~OffscreenGui();
  OffscreenGui(const OffscreenGui&) = delete;
  OffscreenGui& operator=(const OffscreenGui&) = delete;

  /// Advances the model, draws, and returns the content of the window with three channels.
  render::Image frame(double seconds = 0.0);
  /// Draws until all input is delivered and the layout is final. The model does not advance.
  void settle();

  const std::vector<WidgetPlace>& places() const { return screen_.places(); }
  InputQueue& input() { return screen_.input(); }
  void resize(int width, int height);
  /// Draws a view as talus render does.
  render::Image draw_image(const render::FrameView& view, int width) {
    return screen_.draw_image(view, width);
  }
  /// Returns all requests of the widgets since the window was created.
  const GuiRequests& requests() const { return requests_; }

 private:
  void draw(double seconds);

  view::ViewModel& model_;
  GuiScreen screen_;
  Surface surface_;
  GLuint texture_ = 0;
  GuiRequests requests_;
};

}  // namespace talus::gui
