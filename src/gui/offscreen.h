#pragma once
/// The whole window without a display, drawn as a picture, for documents and for tests.

#include <memory>
#include <optional>
#include <vector>

#include "gui/screen.h"

namespace talus::gui {

class OffscreenGui {
 public:
  /// A window of that size, px, in a context without a display; text and widgets are `scale` times as large
  /// as usual. Throws Error(unavailable) if there is no context.
  OffscreenGui(view::ViewModel& model, int width, int height, float scale = 1.0f,
               std::optional<render::ContextKind> kind = std::nullopt);
  ~OffscreenGui();
  OffscreenGui(const OffscreenGui&) = delete;
  OffscreenGui& operator=(const OffscreenGui&) = delete;

  /// Lets time pass for the model, draws, and returns what the window shows: three channels.
  render::Image frame(double seconds = 0.0);
  /// Draws until no input waits any more and the layout is final. No time passes for the model.
  void settle();

  const std::vector<WidgetPlace>& places() const { return screen_.places(); }
  InputQueue& input() { return screen_.input(); }
  void resize(int width, int height);
  /// A view as talus render draws it.
  render::Image draw_image(const render::FrameView& view, int width) {
    return screen_.draw_image(view, width);
  }
  /// Everything that widgets have requested since the window was made.
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
