#pragma once
/// A display in memory with a hand on its mouse and keys: Xvfb, xdotool and ImageMagick.

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <string>

#include "render/image.h"

namespace talus::test {

/// What is missing of the programs, as a sentence; empty where all are there.
std::string missing_for_desktop();

/// A display of 1500 x 1000 px, DISPLAY of this process and those that it starts. No window manager: the
/// window under the mouse has the keys.
class Desktop {
 public:
  Desktop();
  ~Desktop();
  Desktop(const Desktop&) = delete;
  Desktop& operator=(const Desktop&) = delete;

  /// Waits for the window whose title contains the text. False after ten seconds.
  bool wait_for_window(const std::string& title);
  /// That window, as xdotool names it.
  const std::string& window() const { return window_; }
  /// Its title.
  std::string title() const;
  /// Waits until the title contains a text, or does not. False after ten seconds.
  bool wait_for_title(const std::string& text, bool contained = true) const;

  void move(double x, double y) const;  ///< px of the window
  void click() const;
  void drag(double x, double y) const;  ///< from where the mouse is
  void key(const std::string& name) const;
  void resize(int width, int height) const;
  render::Image screenshot(const std::filesystem::path& folder) const;

 private:
  pid_t server_ = -1;
  std::string window_;
};

/// What a command prints, without the last line break.
std::string output_of(const std::string& command);

}  // namespace talus::test
