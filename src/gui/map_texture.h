#pragma once
/// Map of the bed as a texture for widgets.

#include <memory>

#include "gui/draw_data.h"
#include "render/gl_target.h"
#include "render/renderer.h"

namespace talus::gui {

class MapTexture {
 public:
  /// Takes over a current context with its functions `gl`.
  MapTexture(std::unique_ptr<render::Context> context, const render::Gl& gl);

  /// Returns the texture with a view, `width` px wide; the height follows from the view. A view without
  /// legends and titles is redrawn only after a change: without a GPU, 8000 grains take about 6 ms.
  GLuint draw(const render::FrameView& view, int width);

  /// Draws a picture in memory, as talus render does.
  render::Image draw_image(const render::FrameView& view, int width);

 private:
  const render::Gl& gl_;
  render::TextureTarget* target_;  ///< owned by the renderer
  render::Renderer renderer_;
  render::FrameView drawn_;  ///< view in the texture; valid if width_ > 0
  int width_ = 0;
};

}  // namespace talus::gui
