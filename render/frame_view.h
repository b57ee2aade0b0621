#pragma once
/// What the renderer draws: a picture, never the physics. A leaf: it includes nothing of the simulation.
/// Texts are UTF-8; "_c" sets c as a subscript.

#include <string>
#include <vector>

namespace talus {

/// A disc in metres. Shade 0 is white, 1 is black.
struct Disc {
  float x = 0.0f;
  float y = 0.0f;
  float radius = 0.0f;
  float shade = 0.0f;
  float hatched = 0.0f;  ///< 1 for what is not a free grain: the floor; its shade is then not shown
};

/// A labelled tick on the gray bar, at a shade.
struct BarTick {
  double shade = 0.0;
  std::string label;
};

/// A disc of the legend.
struct Swatch {
  double shade = 0.0;
  std::string label;
};

/// One map of the bed with its furniture. Coordinates are those of the bed's frame, in metres.
struct FrameView {
  std::vector<Disc> discs;  ///< in drawing order; copies across a periodic edge included
  double x_min = 0.0, x_max = 0.0, y_min = 0.0, y_max = 0.0;  ///< what is shown; discs are cut at its edges
  bool furniture = true;           ///< false: the bed alone fills the picture; what follows is not drawn
  bool walls = false;              ///< side walls are drawn as lines, instead of a cut at the periodic edge
  bool floor_line = false;         ///< the lower edge is a smooth floor, drawn as a line
  double tilt = 0.0;               ///< rad, for the gravity arrow: gravity points along (sin tilt, -cos tilt)
  std::string title;               ///< left of the caption line: what is shown
  std::string caption;             ///< right of it: angle and its distance to failure
  double scale_length = 0.0;       ///< m
  std::string scale_label;         ///< "10 D"
  std::string bar_title;           ///< "γ = q/p"; no bar where there are no ticks
  std::vector<BarTick> bar_ticks;  ///< by ascending shade
  std::vector<Swatch> swatches;    ///< the legend of a map with few shades
};

}  // namespace talus
