#pragma once
/// The whole window without a display, driven by a program and drawn as a picture, for tests and for pictures
/// of the window in documents.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gui/screen.h"

namespace talus {

class OffscreenGui {
 public:
  /// A window of that size, px, in a context without a display; text and widgets are `scale` times as large
  /// as usual. Throws Error(unavailable) if there is no context.
  OffscreenGui(ViewModel& model, int width, int height, float scale = 1.0f,
               std::optional<ContextKind> kind = std::nullopt);
  ~OffscreenGui();
  OffscreenGui(const OffscreenGui&) = delete;
  OffscreenGui& operator=(const OffscreenGui&) = delete;

  /// Lets time pass for the model, draws, and returns what the window shows: three channels.
  Image frame(double seconds = 0.0);
  /// Draws until no input waits any more and the layout is final. No time passes for the model.
  void settle();

  const std::vector<WidgetPlace>& places() const { return screen_.places(); }
  bool has(std::string_view name) const;
  /// The place of a widget. Throws Error(internal) if none has that name.
  WidgetPlace place(std::string_view name) const;

  // Actions of a user; each settles. A place inside a widget is given as shares of its width and height.
  void move(float x, float y);
  void click(std::string_view name, float share_x = 0.5f, float share_y = 0.5f);
  void double_click(std::string_view name, float share_x = 0.5f, float share_y = 0.5f);
  void drag(std::string_view name, float from_x, float from_y, float to_x, float to_y, int button = 0);
  /// The left button goes down there, with ctrl held, and stays down until let_go.
  void take(std::string_view name, float share_x, float share_y);
  void let_go();
  void scroll(std::string_view name, float steps, float share_x = 0.5f, float share_y = 0.5f);
  /// A printable ASCII character, or a number of KeyCode.
  void key(int code, bool control = false);
  void type(std::string_view text);
  /// A key, as key_left_shift, is held or let go from here on.
  void hold(int key, bool down);

  void resize(int width, int height);
  /// A view as talus render draws it.
  Image draw_image(const FrameView& view, int width) { return screen_.draw_image(view, width); }
  /// Everything that widgets have requested since the window was made.
  const GuiRequests& requests() const { return requests_; }

 private:
  void draw(double seconds);
  void press(int button, bool down);
  void press_key(int key, bool down);

  ViewModel& model_;
  GuiScreen screen_;
  Surface surface_;
  GLuint texture_ = 0;
  GuiRequests requests_;
};

}  // namespace talus
