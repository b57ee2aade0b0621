#pragma once
/// Drawing surfaces for pictures: an OpenGL context (gl_target.h), a vector document (document.h), or in
/// tests a list of the calls.

#include <span>
#include <vector>

#include "render/frame_view.h"
#include "render/image.h"
#include "render/layout.h"

namespace talus::render {

/// A rectangle without a rim.
struct Area {
  Box box;
  std::vector<Colour> colours;  ///< evenly spaced from left to right; a single colour fills the area
};

enum class PixelFormat {
  gray,         ///< one channel: every colour drawn is a gray
  colour,       ///< three channels
  transparent,  ///< four channels: transparent background
};

/// A drawing surface. Between begin and end, later calls draw over earlier ones.
class Target {
 public:
  virtual ~Target() = default;

  /// Begins a picture, white or transparent. Throws Error(unavailable) if it is too large.
  virtual void begin(int width, int height, PixelFormat format) = 0;
  /// Draws the part of the discs that the window shows.
  virtual void draw_discs(std::span<const Disc> discs, const Window& window) = 0;
  virtual void draw_lines(std::span<const Line> lines, const Window& window) = 0;
  virtual void draw_areas(std::span<const Area> areas) = 0;
  /// Draws black texts in a font size of `em` px.
  virtual void draw_texts(std::span<const PlacedText> texts, double em) = 0;
};

/// A target made of pixels.
class ImageTarget : public Target {
 public:
  /// Returns the picture. Throws Error(internal) if drawing failed.
  virtual Image end() = 0;
};

}  // namespace talus::render
