#pragma once
/// The window of `talus view`.

#include <memory>
#include <string>
#include <vector>

#include "gui/gui.h"
#include "render/image.h"

namespace talus {

struct WindowState;

class GuiWindow {
 public:
  /// A window that is not shown yet, `width` x `height` times the scale of the display. Throws
  /// Error(unavailable) where there is no display, or no OpenGL 3.3.
  GuiWindow(int width, int height);
  ~GuiWindow();
  GuiWindow(const GuiWindow&) = delete;
  GuiWindow& operator=(const GuiWindow&) = delete;

  /// Waits until there is something new to show, at most a tenth of a second, and shows it: at most 60
  /// pictures a second, and none where nothing has changed. A file dropped on the window is asked to be
  /// opened.
  GuiRequests next_picture(ViewModel& model);

  bool closed() const;  ///< asked to by its user
  void stay_open();     ///< though it was asked to close
  const std::vector<WidgetPlace>& places() const;
  /// A view as talus render draws it.
  Image draw_image(const FrameView& view, int width);

 private:
  std::unique_ptr<WindowState> state_;
};

}  // namespace talus
