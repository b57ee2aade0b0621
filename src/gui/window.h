#pragma once
/// Window of `talus view`.

#include <memory>
#include <string>
#include <vector>

#include "gui/gui.h"
#include "render/image.h"

namespace talus::gui {

struct WindowState;

class GuiWindow {
 public:
  /// Creates a hidden window, `width` x `height` times the scale of the display. Throws Error(unavailable)
  /// without a display or OpenGL 3.3.
  GuiWindow(int width, int height);
  ~GuiWindow();
  GuiWindow(const GuiWindow&) = delete;
  GuiWindow& operator=(const GuiWindow&) = delete;

  /// Waits for a change for at most a tenth of a second and shows it, with at most 60 pictures per second.
  /// Draws nothing without a change. Dropping a file on the window requests to open it.
  GuiRequests next_picture(view::ViewModel& model);

  bool closed() const;  ///< whether the user has asked to close it
  void stay_open();     ///< cancels that request
  const std::vector<WidgetPlace>& places() const;
  /// Draws a view as talus render does.
  render::Image draw_image(const render::FrameView& view, int width);

 private:
  std::unique_ptr<WindowState> state_;
};

}  // namespace talus::gui
