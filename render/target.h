#pragma once
/// What pictures are drawn on: an OpenGL context (gl_target.h), a document of vectors (pdf_target.h,
/// svg_target.h), or in tests a list of what was drawn.

#include <span>
#include <vector>

#include "render/frame_view.h"
#include "render/image.h"
#include "render/layout.h"

namespace talus::render {

/// A rectangle without a rim.
struct Area {
  Box box;
  std::vector<Colour> colours;  ///< from left to right, evenly spaced; only one: plain
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
  virtual void draw_areas(std::span<const Area> areas) = 0;
  /// Black, in a font size of `em` px.
  virtual void draw_texts(std::span<const PlacedText> texts, double em) = 0;
};

/// A target of pixels.
class ImageTarget : public Target {
 public:
  /// The picture. Throws Error(internal) if drawing failed.
  virtual Image end() = 0;
};

}  // namespace talus::render
