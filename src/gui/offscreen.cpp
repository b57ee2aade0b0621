#include "gui/offscreen.h"

#include <algorithm>
#include <cctype>
#include <fmt/core.h>

#include "core/errors.h"

namespace talus {
namespace {

/// Between two pictures as ImGui sees it, s: so long that two clicks are no double click.
constexpr double picture_seconds = 0.1;

float between(float low, float high, float share) { return low + share * (high - low); }

}  // namespace

OffscreenGui::OffscreenGui(ViewModel& model, int width, int height, float scale,
                           std::optional<ContextKind> kind)
    : model_(model), screen_(make_context(kind), scale) {
  screen_.gl().GenFramebuffers(1, &surface_.framebuffer);
  surface_.top_row_first = true;
  resize(width, height);
}

OffscreenGui::~OffscreenGui() {
  screen_.gl().DeleteFramebuffers(1, &surface_.framebuffer);
  screen_.gl().DeleteTextures(1, &texture_);
}

void OffscreenGui::resize(int width, int height) {
  const Gl& gl = screen_.gl();
  gl.DeleteTextures(1, &texture_);
  texture_ = make_texture(gl, width, height, 4, nullptr, GL_NEAREST);
  gl.BindFramebuffer(GL_FRAMEBUFFER, surface_.framebuffer);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error(ExitCode::unavailable,
                fmt::format("the rendering context offers no window of {} x {} px; ask for a smaller one",
                            width, height));
  surface_.width = width;
  surface_.height = height;
  settle();
}

void OffscreenGui::draw(double seconds) {
  model_.update(seconds);
  const GuiRequests requests =
      screen_.draw(model_, surface_, surface_.width, surface_.height, picture_seconds);
  requests_.quit = requests_.quit || requests.quit;
  if (!requests.open_path.empty()) requests_.open_path = requests.open_path;
  if (!requests.save_png_path.empty()) requests_.save_png_path = requests.save_png_path;
  if (!requests.behind_path.empty()) requests_.behind_path = requests.behind_path;
  if (!requests.plots_folder.empty()) requests_.plots_folder = requests.plots_folder;
}

Image OffscreenGui::frame(double seconds) {
  draw(seconds);
  Image image{surface_.width, surface_.height, 3, {}};
  image.pixels.resize(image.row_bytes() * static_cast<std::size_t>(image.height));
  const Gl& gl = screen_.gl();
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, image.width, image.height, GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());
  if (const GLenum error = gl.GetError(); error != GL_NO_ERROR)
    throw Error(ExitCode::internal, fmt::format("OpenGL reports error {} while drawing the window", error));
  return image;
}

void OffscreenGui::settle() {
  while (screen_.input().waiting()) draw(0.0);
  for (int k = 0; k < 3; ++k) draw(0.0);  // ImGui knows sizes and what is under the mouse one picture later
}

bool OffscreenGui::has(std::string_view name) const {
  return std::ranges::any_of(places(), [name](const WidgetPlace& place) { return place.name == name; });
}

WidgetPlace OffscreenGui::place(std::string_view name) const {
  for (const WidgetPlace& place : places())
    if (place.name == name) return place;
  std::string known;
  for (const WidgetPlace& place : places()) known += (known.empty() ? "" : ", ") + place.name;
  throw Error(ExitCode::internal, fmt::format("no widget \"{}\" in the window; there are: {}", name, known));
}

void OffscreenGui::move(float x, float y) {
  screen_.input().add({InputEvent::Kind::position, x, y, 0, false});
  settle();
}

void OffscreenGui::press(int button, bool down) {
  screen_.input().add({InputEvent::Kind::button, 0.0f, 0.0f, button, down});
}

void OffscreenGui::press_key(int key, bool down) {
  screen_.input().add({InputEvent::Kind::key, 0.0f, 0.0f, key, down});
}

void OffscreenGui::click(std::string_view name, float share_x, float share_y) {
  const WidgetPlace at = place(name);
  move(between(at.x0, at.x1, share_x), between(at.y0, at.y1, share_y));
  press(0, true);
  press(0, false);
  settle();
}

void OffscreenGui::double_click(std::string_view name, float share_x, float share_y) {
  const WidgetPlace at = place(name);
  move(between(at.x0, at.x1, share_x), between(at.y0, at.y1, share_y));
  for (const bool down : {true, false, true, false}) press(0, down);
  settle();
}

void OffscreenGui::drag(std::string_view name, float from_x, float from_y, float to_x, float to_y,
                        int button) {
  const WidgetPlace at = place(name);
  move(between(at.x0, at.x1, from_x), between(at.y0, at.y1, from_y));
  press(button, true);
  settle();
  constexpr int parts = 4;
  for (int k = 1; k <= parts; ++k) {
    const float share = static_cast<float>(k) / parts;
    move(between(at.x0, at.x1, between(from_x, to_x, share)),
         between(at.y0, at.y1, between(from_y, to_y, share)));
  }
  press(button, false);
  settle();
}

void OffscreenGui::take(std::string_view name, float share_x, float share_y) {
  const WidgetPlace at = place(name);
  move(between(at.x0, at.x1, share_x), between(at.y0, at.y1, share_y));
  press_key(key_left_control, true);
  press(0, true);
  settle();
}

void OffscreenGui::let_go() {
  press(0, false);
  press_key(key_left_control, false);
  settle();
}

void OffscreenGui::scroll(std::string_view name, float steps, float share_x, float share_y) {
  const WidgetPlace at = place(name);
  move(between(at.x0, at.x1, share_x), between(at.y0, at.y1, share_y));
  screen_.input().add({InputEvent::Kind::wheel, 0.0f, steps, 0, false});
  settle();
}

void OffscreenGui::key(int code, bool control) {
  const bool printable = code > key_space && code < 127;
  const int number = printable ? std::toupper(code) : code;
  if (control) press_key(key_left_control, true);
  press_key(number, true);
  if ((printable || code == key_space) && !control)
    screen_.input().add({InputEvent::Kind::character, 0.0f, 0.0f, code, false});
  press_key(number, false);
  if (control) press_key(key_left_control, false);
  settle();
}

void OffscreenGui::hold(int key, bool down) {
  press_key(key, down);
  settle();
}

void OffscreenGui::type(std::string_view text) {
  for (const char character : text) key(static_cast<unsigned char>(character));
}

}  // namespace talus
