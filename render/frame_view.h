#pragma once
/// What the renderer draws: a picture, without any physics. This header includes nothing of the simulation.
/// Texts are UTF-8; "_c" sets c as a subscript.

#include <limits>
#include <string>
#include <vector>

#include "render/colour.h"

namespace talus::render {

/// A disc in metres, with a rim inside its edge. Hatched is 1 for grains of the floor; lines in
/// the colour of the rim are then drawn over the fill.
struct Disc {
  float x = 0.0f;
  float y = 0.0f;
  float radius = 0.0f;
  Colour fill = white;
  Colour rim = black;
  float hatched = 0.0f;
};

/// A straight line with round ends, in metres. It is drawn above the discs, and never too thin to be seen.
struct Line {
  float x0 = 0.0f, y0 = 0.0f;
  float x1 = 0.0f, y1 = 0.0f;
  float half_width = 0.0f;
  Colour colour = black;
};

/// A labelled tick, at a share of the length of its bar.
struct BarTick {
  double share = 0.0;
  std::string label;
};

/// A gray or colour bar.
struct Bar {
  std::string title;             ///< "γ = q/p"
  std::vector<Colour> colours;   ///< from left to right, evenly spaced, two or more
  std::vector<BarTick> ticks;    ///< by ascending share
  double low = 0.0, high = 1.0;  ///< values at its ends
  bool logarithmic = false;      ///< then 0 < low
  // What is not drawn, but told of a disc.
  std::string symbol{}, unit{};  ///< rich texts: "u", "D per degree"
  std::vector<double> values{};  ///< by the numbers of grains; NaN where there is none
};

/// A disc or a line of the legend.
struct Swatch {
  enum class Kind { disc, line };
  Kind kind = Kind::disc;
  Colour fill = white;  ///< of a line: its colour
  Colour rim = black;   ///< of a disc
  double width = 0.25;  ///< of a line, in units of the height of the swatch
  std::string label;
};

/// The legend of one layer of a map: a bar, or swatches, or both.
struct Legend {
  std::vector<Bar> bars;
  std::vector<Swatch> swatches;
};

/// A tick of an axis, at a value.
struct AxisTick {
  double value = 0.0;
  std::string label;
};

/// A curve under the map, with a mark where the frame is.
struct Trace {
  std::string title;         ///< "Γ = Q/P", set above its frame
  std::vector<double> x, y;  ///< of equal length, x ascending; NaN in y breaks the line
  double x_min = 0.0, x_max = 1.0, y_min = 0.0, y_max = 1.0;
  std::vector<AxisTick> x_ticks, y_ticks;
  std::string x_title;                                      ///< "θ in °"
  double mark = 0.0;                                        ///< x of the frame shown
  double event = std::numeric_limits<double>::quiet_NaN();  ///< x of a dashed line: failure; NaN: none
  std::string event_label;                                  ///< "θ_c"
};

/// One map of the bed with its furniture, or furniture alone, where x_max is not above x_min. Coordinates are
/// those of the bed's frame, in metres.
struct FrameView {
  std::vector<Disc> discs;  ///< in drawing order; copies across a periodic edge included
  std::vector<Line> lines;  ///< above them
  double x_min = 0.0, x_max = 0.0, y_min = 0.0,
         y_max = 0.0;  ///< what is shown; everything is cut at its edges
  double turn = 0.0;   ///< rad: the bed is drawn turned clockwise by it, so that it slopes down to the right
  double turn_max = 0.0;     ///< rad, >= turn >= 0: the picture has room for all turns up to this one
  bool coloured = false;     ///< a picture in colour, even if everything in it is gray
  bool transparent = false;  ///< nothing behind the discs, instead of white
  bool furniture = true;     ///< false: the bed alone fills the picture; what follows is not drawn
  double letters = 90.0;     ///< so many font sizes are as wide as the picture
  double most_letters = std::numeric_limits<double>::infinity();  ///< of a smaller type it is not drawn
  bool left_wall = false;       ///< a wall stands at x_min, and is drawn as a line
  bool right_wall = false;      ///< the same at x_max
  bool floor_line = false;      ///< y_min is a smooth floor, drawn as a line
  double tilt = 0.0;            ///< rad, for the gravity arrow: gravity points along (sin tilt, -cos tilt)
  std::string title;            ///< left of the caption line: what is shown
  std::string caption;          ///< right of it: angle and its distance to failure
  double scale_length = 0.0;    ///< m
  std::string scale_label;      ///< "10 D"; if empty, neither scale bar nor arrow is drawn
  std::vector<Legend> legends;  ///< of the layers, below the bed
  std::vector<Trace> traces;    ///< below the legends, one below the other
  double trace_height = 5.0;    ///< of the frame of each, in font sizes
};

}  // namespace talus::render
