#pragma once
/// The map of the bed as a texture for widgets.

#include <memory>

#include "gui/draw_data.h"
#include "render/gl_target.h"
#include "render/renderer.h"

namespace talus {

class MapTexture {
 public:
  /// Takes a current context; `gl` are its functions.
  MapTexture(std::unique_ptr<Context> context, const Gl& gl);

  /// The texture with a view, `width` px wide and as high as follows from it. A view without furniture is
  /// drawn again only where it has changed: without a GPU 8000 grains take some 6 ms.
  GLuint draw(const FrameView& view, int width);

  /// A picture in memory, as talus render draws it.
  Image draw_image(const FrameView& view, int width);

 private:
  const Gl& gl_;
  TextureTarget* target_;  ///< of the renderer
  Renderer renderer_;
  FrameView drawn_;  ///< what the texture shows; valid where width_ > 0
  int width_ = 0;
};

}  // namespace talus
