#pragma once
/// What pictures are drawn on: an OpenGL context (gl_target.h), or in tests a list of what was drawn.

#include <span>

#include "render/font.h"
#include "render/frame_view.h"
#include "render/image.h"
#include "render/layout.h"

namespace talus::render {

/// A corner of a triangle: a glyph of the atlas, or a plain area where u < 0.
struct FurnitureVertex {
  float x, y;  ///< px from the left and from the top
  float u, v;  ///< in the atlas
  Colour colour;
};

enum class PixelFormat {
  gray,         ///< one channel: every colour drawn is a gray
  colour,       ///< three channels
  transparent,  ///< four: transparent where nothing is drawn
};

/// Later calls between begin and end draw over earlier ones.
class Target {
 public:
  virtual ~Target() = default;

  /// Begins a picture, white or transparent. Throws Error(unavailable) if it is too large.
  virtual void begin(int width, int height, PixelFormat format) = 0;
  /// What is seen through a window: cut at its edges.
  virtual void draw_discs(std::span<const Disc> discs, const Window& window) = 0;
  virtual void draw_lines(std::span<const Line> lines, const Window& window) = 0;
  virtual void draw_triangles(std::span<const FurnitureVertex> triangles, const GlyphAtlas& atlas) = 0;
  /// The picture. Throws Error(internal) if drawing failed.
  virtual Image end() = 0;
};

}  // namespace talus::render
