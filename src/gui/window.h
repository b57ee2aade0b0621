#pragma once
/// The window of `talus view`.

#include <memory>
#include <string>
#include <vector>

#include "gui/gui.h"
#include "render/image.h"

namespace talus::gui {

struct WindowState;

class GuiWindow {
 public:
  /// A window that is not shown yet, `width` x `height` times the scale of the display. Throws
  /// Error(unavailable) if there is no display, or no OpenGL 3.3.
  GuiWindow(int width, int height);
  ~GuiWindow();
  GuiWindow(const GuiWindow&) = delete;
  GuiWindow& operator=(const GuiWindow&) = delete;

  /// Waits until there is something new to show, for at most a tenth of a second, and shows it: at most 60
  /// pictures a second, and none if nothing has changed. Dropping a file on the window requests to open
  /// it.
  GuiRequests next_picture(view::ViewModel& model);

  bool closed() const;  ///< whether its user asked to close it
  void stay_open();     ///< cancels that request
  const std::vector<WidgetPlace>& places() const;
  /// A view as talus render draws it.
  render::Image draw_image(const render::FrameView& view, int width);

 private:
  std::unique_ptr<WindowState> state_;
};

}  // namespace talus::gui
