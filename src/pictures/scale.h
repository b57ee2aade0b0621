#pragma once
/// From a value to the look of a grain, and the bar that says so.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/colour_map.h"
#include "render/frame_view.h"

namespace talus::pictures {

/// How a grain is drawn by a layer.
struct GrainLook {
  render::Colour fill = render::white;
  render::Colour rim = render::black;
  bool marked = true;  ///< false: the layer has nothing to say of it, and marks nothing over another layer
};

/// The rim of a grain: darker than its fill, and never lighter than a gray that shows a white grain on white;
/// of a dark colour, on which no darker one is seen, lighter. Black has a black one.
render::Colour rim_of(const render::Colour& fill);

/// A grain that only shows where it is.
GrainLook outline_look();

/// Values from low to high, in colours.
struct Scale {
  render::ColourMap colours = render::ColourMap::gray;
  double low = 0.0;
  double high = 1.0;
  bool logarithmic = false;  ///< then 0 < low
};

/// What users chose of the scale of a layer.
struct ScaleChoice {
  std::optional<render::ColourMap> colours;
  std::optional<double> low, high;
};

/// A scale with what was chosen instead of its own. Throws Error(usage) where that leaves no range.
Scale chosen(Scale scale, const ScaleChoice& choice);

/// Where a value is between the ends, not clamped: 0 at low, 1 at high.
double share_of(const Scale& scale, double value);

/// A value in the colours of its scale, beyond its ends as at them. NaN, of a grain that has no value, looks
/// as the lower end and is not marked.
GrainLook look_of(const Scale& scale, double value);
std::vector<GrainLook> looks_of(const Scale& scale, std::span<const double> values);

/// The same in colours of a scale none of which is white; a grain that has no value is.
std::vector<GrainLook> looks_or_outlines(const Scale& scale, std::span<const double> values);

/// The bar, with round numbers, or decades, as ticks.
render::Bar bar_of(const Scale& scale, const std::string& title);

}  // namespace talus::pictures
