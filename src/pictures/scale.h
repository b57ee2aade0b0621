#pragma once
/// Maps values to the looks of grains, and makes the matching bar.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/colour_map.h"
#include "render/frame_view.h"

namespace talus::pictures {

/// The look of a grain in a layer.
struct GrainStyle {
  render::Colour fill = render::white;
  render::Colour rim = render::black;
  bool marked = true;  ///< false: the layer has no value for the grain and draws no mark over another layer
};

/// Returns the rim of a grain: darker than its fill, and at least as dark as the gray that makes a white
/// grain visible on white. A dark colour has a lighter rim, because a darker one would be invisible; black
/// has a black rim.
render::Colour rim_of(const render::Colour& fill);

/// Returns the look of a grain that only shows its position.
GrainStyle outline_style();

/// A range of values and its colours.
struct Scale {
  render::ColourMap colours = render::ColourMap::gray;
  double low = 0.0;
  double high = 1.0;
  bool logarithmic = false;  ///< requires low > 0
};

/// The user's choices for the scale of a layer.
struct ScaleChoice {
  std::optional<render::ColourMap> colours;
  std::optional<double> low, high;
};

/// Returns a scale with the user's choices applied. Throws Error(usage) if no range remains.
Scale chosen(Scale scale, const ScaleChoice& choice);

/// Returns the position of a value between the ends, not clamped: 0 at low, 1 at high.
double share_of(const Scale& scale, double value);

/// Returns the look of a value, clamped to the ends of its scale. NaN, for a grain without a value, looks
/// like the lower end and is not marked.
GrainStyle grain_style(const Scale& scale, double value);
std::vector<GrainStyle> grain_styles(const Scale& scale, std::span<const double> values);

/// Returns looks on a scale that does not contain white; grains without a value are white.
std::vector<GrainStyle> grain_styles_or_outlines(const Scale& scale, std::span<const double> values);

/// Returns the bar, with round numbers or decades as ticks.
render::Bar bar_of(const Scale& scale, const std::string& title);

}  // namespace talus::pictures
