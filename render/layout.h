#pragma once
/// The layout of a picture: from a view and a width to rectangles in pixels, without drawing.

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "render/font.h"
#include "render/frame_view.h"

namespace talus::render {

/// A rectangle, px from the left and from the top of the picture.
struct Box {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

/// A place in a picture, px from the left and from the top.
struct Point {
  double x = 0.0, y = 0.0;
};

/// From metres in the frame of the bed to pixels: a clockwise turn, then a scale.
struct Camera {
  double scale = 1.0;     ///< px per m
  double origin_x = 0.0;  ///< where (0, 0) lies: px from the left
  double origin_y = 0.0;  ///< px from the top
  double cosine = 1.0;    ///< of the turn
  double sine = 0.0;

  Point project(double x, double y) const {
    return {origin_x + scale * (cosine * x + sine * y), origin_y - scale * (cosine * y - sine * x)};
  }
};

/// A part of a picture that shows a part of a plane. Nothing outside of either is drawn.
struct Window {
  Camera camera;
  Box box;                                                    ///< whole pixels
  double x_min = 0.0, x_max = 0.0, y_min = 0.0, y_max = 0.0;  ///< m
};

struct PlacedText {
  Box box;
  std::string text;
};
/// px from the top: where the letters of a text stand, on a whole pixel.
double base_line_of(const PlacedText& text, double em);

struct PlacedBar {
  Box box;
  std::vector<Colour> colours;
  std::vector<double> ticks;  ///< x of the ticks below it
};

struct PlacedSwatch {
  Box box;
  Swatch swatch;
};

/// A tick of a trace: where it is along its axis, px.
struct PlacedTrace {
  Box box;                                                  ///< its frame
  std::vector<double> x_ticks, y_ticks;                     ///< px
  std::vector<Point> curve;                                 ///< a point with NaN parts it
  Point mark;                                               ///< NaN where the curve has no value there
  double event = std::numeric_limits<double>::quiet_NaN();  ///< x of the dashed line
};

/// One picture. Boxes of parts that the view does not ask for are empty.
struct Layout {
  int width = 0, height = 0;  ///< px
  double em = 0.0;            ///< font size, px
  Window bed;
  std::vector<PlacedText> texts;
  std::vector<PlacedBar> bars;
  std::vector<PlacedSwatch> swatches;
  Box scale_bar;
  Box arrow;  ///< square; gravity turns about its centre
  std::vector<PlacedTrace> traces;
  double traces_top = 0.0;  ///< px: of the title of the first
};

/// Smallest and largest side of a picture, px.
inline constexpr int smallest_width = 200;
inline constexpr int largest_side = 16384;

/// What pictures beside each other, or one after the other, have in common.
struct LayoutLimits {
  double largest_em = std::numeric_limits<double>::infinity();
  double bed_top = 0.0;     ///< px: the bed, or what stands below it, begins here or below
  double traces_top = 0.0;  ///< px
  bool own_turn = false;    ///< a turned bed gets the height that its turn needs, not that of turn_max
};

/// Lays out a picture `width` px wide: caption, bed, legends, traces. The height follows from the aspect of
/// the bed. The font grows with the width, as the view asks for, up to `largest_em`. If a text does not fit,
/// the font shrinks a little, then lines are broken, then it shrinks as far as can be read.
/// Throws Error(usage) if nothing legible fits, or if the picture is larger than largest_side.
Layout lay_out(const FrameView& view, int width, const Font& font, const LayoutLimits& limits = {});

/// Moves all of a layout, by whole pixels.
void move_by(Layout& layout, double x, double y);

/// Limits with which the beds of pictures are level, and so are their traces, beside or after each other.
LayoutLimits level(std::span<const FrameView> views, int width, const Font& font, LayoutLimits limits);

}  // namespace talus::render
