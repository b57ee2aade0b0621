#pragma once
/// The map of the bed as a texture for widgets.

#include <memory>

#include "gui/draw_data.h"
#include "render/gl_target.h"
#include "render/renderer.h"

namespace talus::gui {

class MapTexture {
 public:
  /// Takes a current context; `gl` are its functions.
  MapTexture(std::unique_ptr<render::Context> context, const render::Gl& gl);

  /// The texture with a view, `width` px wide and as high as follows from it. A view without furniture is
  /// drawn again only where it has changed: without a GPU 8000 grains take some 6 ms.
  GLuint draw(const render::FrameView& view, int width);

  /// A picture in memory, as talus render draws it.
  render::Image draw_image(const render::FrameView& view, int width);

 private:
  const render::Gl& gl_;
  render::TextureTarget* target_;  ///< of the renderer
  render::Renderer renderer_;
  render::FrameView drawn_;  ///< what the texture shows; valid where width_ > 0
  int width_ = 0;
};

}  // namespace talus::gui
