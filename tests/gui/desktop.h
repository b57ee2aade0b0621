#pragma once
/// Display in memory with control over mouse and keys: Xvfb, xdotool and ImageMagick.

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "render/image.h"

namespace talus::test {

/// Returns a sentence on the programs that are missing; empty if all are installed.
std::string missing_for_desktop();

/// Display of 1500 x 1000 px, set as DISPLAY of this process and its children. There is no window manager:
/// the window under the mouse receives the keys.
class Desktop {
 public:
  explicit Desktop(bool has_opengl = true);
  ~Desktop();
  Desktop(const Desktop&) = delete;
  Desktop& operator=(const Desktop&) = delete;

  /// Waits for a window whose title contains the text; returns false after ten seconds.
  bool wait_for_window(const std::string& title);
  /// Returns that window's id for xdotool.
  const std::string& window() const { return window_; }
  /// Returns its title.
  std::string title() const;
  /// Waits until the title contains a text, or no longer does; returns false after ten seconds.
  bool wait_for_title(const std::string& text, bool contained = true) const;

  void move(double x, double y) const;  ///< px of the window
  void click() const;
  void drag(double x, double y) const;  ///< starts at the position of the mouse
  void key(const std::string& name) const;
  void resize(int width, int height) const;
  render::Image screenshot(const std::filesystem::path& folder) const;

 private:
  pid_t server_ = -1;
  std::string window_;
};

/// Returns the output of a command without the last line break.
std::string output_of(const std::string& command);

}  // namespace talus::test
