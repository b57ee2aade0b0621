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

/// A point in a picture, px from the left and from the top.
struct Point {
  double x = 0.0, y = 0.0;
};

/// Maps metres in the frame of the bed to pixels: a clockwise turn followed by scaling.
struct Camera {
  double scale = 1.0;     ///< px per m
  double origin_x = 0.0;  ///< position of (0, 0), px from the left
  double origin_y = 0.0;  ///< px from the top
  double cosine = 1.0;    ///< cosine of the turn
  double sine = 0.0;

  Point project(double x, double y) const {
    return {origin_x + scale * (cosine * x + sine * y), origin_y - scale * (cosine * y - sine * x)};
  }
};

/// A part of a picture that shows a part of a plane. Drawing is clipped to both.
struct Window {
  Camera camera;
  Box box;                                                    ///< whole pixels
  double x_min = 0.0, x_max = 0.0, y_min = 0.0, y_max = 0.0;  ///< m
};

/// Returns the corners of the part of the picture that a window shows.
std::vector<Point> seen_corners(const Window& window);

struct PlacedText {
  Box box;
  std::string text;
};
/// Returns the base line of a text, px from the top, on a whole pixel.
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

/// A trace with its ticks, px along the axes.
struct PlacedTrace {
  Box box;                                                  ///< frame of the curve
  std::vector<double> x_ticks, y_ticks;                     ///< px
  std::vector<Point> curve;                                 ///< a point with NaN interrupts the curve
  Point mark;                                               ///< NaN if the curve has no value there
  double event = std::numeric_limits<double>::quiet_NaN();  ///< x of the dashed line
};

/// One picture. The boxes of parts that the view does not request are empty.
struct Layout {
  int width = 0, height = 0;  ///< px
  double em = 0.0;            ///< font size, px
  Window bed;
  std::vector<PlacedText> texts;
  std::vector<PlacedBar> bars;
  std::vector<PlacedSwatch> swatches;
  Box scale_bar;
  Box arrow;  ///< a square; the gravity arrow turns about its centre
  std::vector<PlacedTrace> traces;
  double caption_top = 0.0;  ///< px: top of the caption
  double traces_top = 0.0;   ///< px: top of the first trace's title
};

/// Smallest and largest side of a picture, px.
inline constexpr int smallest_width = 200;
inline constexpr int largest_side = 16384;

/// Limits shared by pictures shown next to each other or one after the other.
struct LayoutLimits {
  double largest_em = std::numeric_limits<double>::infinity();
  double caption_top = 0.0;  ///< px: the caption begins at this height or lower
  double bed_top = 0.0;      ///< px: the bed, or the furniture below it, begins at this height or lower
  double traces_top = 0.0;   ///< px
  bool own_turn = false;     ///< turned beds as high as their own turn needs, with the caption at the left
};

/// Lays out a picture `width` px wide: caption, bed, legends, traces. The height follows from the aspect
/// ratio of the bed. The font grows with the width as the view requests, up to `largest_em`. If a text does
/// not fit, the font shrinks slightly, then lines are broken, then the font shrinks to the limit of
/// legibility. Throws Error(usage) if nothing legible fits, or if the picture exceeds largest_side.
Layout lay_out(const FrameView& view, int width, const Font& font, const LayoutLimits& limits = {});

/// Returns the distance, px, by which a picture can move up to one above it until they touch, on a sheet of
/// this width; infinite if they are not above each other. A turned bed counts as it is, not as its box.
double room_between(const Layout& above, const Layout& below, int width);

/// Moves an entire layout by whole pixels.
void move_by(Layout& layout, double x, double y);

/// Returns limits that align the captions of pictures with each other, and also their beds and traces.
LayoutLimits level(std::span<const FrameView> views, int width, const Font& font, LayoutLimits limits);

}  // namespace talus::render
