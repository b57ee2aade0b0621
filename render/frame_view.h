#pragma once
/// The input of the renderer: a picture, without any physics. This header includes nothing of the simulation.
/// Texts are UTF-8; "_c" sets c as a subscript.

#include <limits>
#include <string>
#include <vector>

#include "render/colour.h"

namespace talus::render {

/// A disc in metres, with a rim inside its edge. `hatched` is 1 for grains of the floor; their fill is
/// overlaid with lines in the colour of the rim.
struct Disc {
  float x = 0.0f;
  float y = 0.0f;
  float radius = 0.0f;
  Colour fill = white;
  Colour rim = black;
  float hatched = 0.0f;
};

/// A straight line with round ends, in metres. It is drawn above the discs, and is always wide enough to be
/// visible.
struct Line {
  float x0 = 0.0f, y0 = 0.0f;
  float x1 = 0.0f, y1 = 0.0f;
  float half_width = 0.0f;
  Colour colour = black;
};

/// A labelled tick, at a fraction of the length of its bar.
struct BarTick {
  double share = 0.0;
  std::string label;
};

/// A gray or colour bar.
struct Bar {
  std::string title;             ///< for example "γ = q/p"
  std::vector<Colour> colours;   ///< evenly spaced from left to right, two or more
  std::vector<BarTick> ticks;    ///< ordered by ascending share
  double low = 0.0, high = 1.0;  ///< values at its ends
  bool logarithmic = false;      ///< requires low > 0
  // The following members are not drawn; they are shown when the mouse hovers over a disc.
  std::string symbol{}, unit{};  ///< rich texts, such as "u" and "D per degree"
  std::vector<double> values{};  ///< indexed by grain number; NaN if a grain has no value
};

/// A disc or a line of the legend.
struct Swatch {
  enum class Kind { disc, line };
  Kind kind = Kind::disc;
  Colour fill = white;  ///< for a line, its colour
  Colour rim = black;   ///< discs only
  double width = 0.25;  ///< lines only, in units of the height of the swatch
  std::string label;
  bool operator==(const Swatch&) const = default;
};

/// The legend of one layer of a map: bars, swatches, or both.
struct Legend {
  std::vector<Bar> bars;
  std::vector<Swatch> swatches;
};

/// A tick of an axis, at a value.
struct AxisTick {
  double value = 0.0;
  std::string label;
};

/// A curve below the map, with a mark at the frame shown.
struct Trace {
  std::string title;         ///< for example "Γ = Q/P", set above its frame
  std::vector<double> x, y;  ///< equally long, x ascending; NaN in y breaks the line
  double x_min = 0.0, x_max = 1.0, y_min = 0.0, y_max = 1.0;
  std::vector<AxisTick> x_ticks, y_ticks;
  std::string x_title;                                      ///< for example "θ (°)"
  double mark = 0.0;                                        ///< x of the frame shown
  double event = std::numeric_limits<double>::quiet_NaN();  ///< x of a dashed line at failure; NaN: none
  std::string event_label;                                  ///< for example "θ_c"
};

/// One map of the bed with its furniture, or furniture alone if x_max <= x_min. Coordinates are in the frame
/// of the bed, in metres.
struct FrameView {
  std::vector<Disc> discs;  ///< drawing order, including copies across a periodic edge
  std::vector<Line> lines;  ///< drawn above the discs
  double x_min = 0.0, x_max = 0.0, y_min = 0.0,
         y_max = 0.0;        ///< the part shown; everything is clipped at its edges
  double turn = 0.0;         ///< rad; the bed is drawn rotated clockwise by it, sloping down to the right
  double turn_max = 0.0;     ///< rad, >= turn >= 0; the picture has room for all turns up to this one
  bool coloured = false;     ///< a picture in colour, even if everything in it is gray
  bool transparent = false;  ///< nothing behind the discs, instead of white
  bool furniture = true;     ///< false: the bed alone fills the picture, and the members below are not drawn
  double letters = 90.0;     ///< width of the picture in font sizes
  double max_letters =
      std::numeric_limits<double>::infinity();  ///< upper limit of `letters`, below which the type is legible
  bool left_wall = false;                       ///< a wall at x_min, drawn as a line
  bool right_wall = false;                      ///< a wall at x_max, drawn as a line
  bool floor_line = false;                      ///< y_min is a smooth floor, drawn as a line
  double tilt = 0.0;              ///< rad, for the gravity arrow: gravity points along (sin tilt, -cos tilt)
  std::string title;              ///< quantity shown, at the left of the caption line
  std::string caption;            ///< tilt and its distance to failure, at the right of the caption line
  double scale_length = 0.0;      ///< m
  std::string scale_label;        ///< for example "10 D"; if empty, neither scale bar nor arrow is drawn
  bool arrow_in_caption = false;  ///< the gravity arrow follows the caption, not the scale bar
  std::vector<Legend> legends;    ///< legends of the layers, below the bed
  std::vector<Trace> traces;      ///< below the legends, one below the other
  double trace_height = 5.0;      ///< height of the frame of each trace, in font sizes
};

}  // namespace talus::render
