#pragma once
/// Where pictures are drawn: in an OpenGL context (gl_target.h), or nowhere, by tests that look at what is
/// asked for.

#include <span>

#include "render/font.h"
#include "render/frame_view.h"
#include "render/image.h"
#include "render/layout.h"

namespace talus {

/// A corner of a triangle: a glyph of the atlas, or a plain area where u < 0.
struct FurnitureVertex {
  float x, y;  ///< px from the left and from the top
  float u, v;  ///< in the atlas
  Colour colour;
};

enum class PixelFormat {
  gray,         ///< one channel: every colour drawn is a gray
  colour,       ///< three channels
  transparent,  ///< four: what is not drawn on is clear
};

/// Draws go on top of each other in the order of the calls between begin and end.
class Target {
 public:
  virtual ~Target() = default;

  /// Begins a picture, white or clear. Throws Error(unavailable) where it is too large.
  virtual void begin(int width, int height, PixelFormat format) = 0;
  /// What is seen through a window: cut at its edges.
  virtual void draw_discs(std::span<const Disc> discs, const Window& window) = 0;
  virtual void draw_lines(std::span<const Line> lines, const Window& window) = 0;
  virtual void draw_triangles(std::span<const FurnitureVertex> triangles, const GlyphAtlas& atlas) = 0;
  /// The picture. Throws Error(internal) where drawing failed.
  virtual Image end() = 0;
};

}  // namespace talus
