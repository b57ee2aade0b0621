#include "gui/offscreen.h"

#include <fmt/core.h>

#include "base/errors.h"

namespace talus::gui {
namespace {

/// Time between two pictures for ImGui, s: long enough that two clicks are not a double click.
constexpr double picture_seconds = 0.1;

}  // namespace

OffscreenGui::OffscreenGui(view::ViewModel& model, int width, int height, float scale,
                           std::optional<render::ContextKind> kind)
    : model_(model), screen_(render::make_context(kind), scale) {
  screen_.gl().GenFramebuffers(1, &surface_.framebuffer);
  surface_.top_row_first = true;
  resize(width, height);
}

OffscreenGui::~OffscreenGui() {
  screen_.gl().DeleteFramebuffers(1, &surface_.framebuffer);
  screen_.gl().DeleteTextures(1, &texture_);
}

void OffscreenGui::resize(int width, int height) {
  const render::Gl& gl = screen_.gl();
  gl.DeleteTextures(1, &texture_);
  texture_ = render::make_texture(gl, width, height, 4, nullptr, GL_NEAREST);
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
  if (!requests.plots_folder.empty()) requests_.plots_folder = requests.plots_folder;
}

render::Image OffscreenGui::frame(double seconds) {
  draw(seconds);
  render::Image image{surface_.width, surface_.height, 3, {}};
  image.pixels.resize(image.row_bytes() * static_cast<std::size_t>(image.height));
  const render::Gl& gl = screen_.gl();
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, image.width, image.height, GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());
  if (const GLenum error = gl.GetError(); error != GL_NO_ERROR)
    throw Error(ExitCode::internal, fmt::format("OpenGL reports error {} while drawing the window", error));
  return image;
}

void OffscreenGui::settle() {
  while (screen_.input().waiting()) draw(0.0);
  for (int k = 0; k < 3; ++k)
    draw(0.0);  // ImGui needs one more picture to know sizes and what is under the mouse
}

}  // namespace talus::gui
