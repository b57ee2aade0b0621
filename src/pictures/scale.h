#pragma once
/// Maps values to the looks of grains, and makes the matching bar.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/colour.h"
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
/// Returns the looks of values; with `outlines`, for a scale without white, grains without a value are white.
std::vector<GrainStyle> grain_styles(const Scale& scale, std::span<const double> values, bool outlines);

/// Returns the bar, with round numbers or decades as ticks.
render::Bar bar_of(const Scale& scale, const std::string& title);

/// A round number on a scale.
struct RoundTick {
  double value = 0.0;
  std::string label;  ///< all labels of a scale have the same number of decimals and the same power of ten
};

/// Whether a number is easier to read as a power of ten: below 0.001, and from 100 000 on.
bool needs_power(double value);
/// Returns a number > 0 with up to six digits, "2·10⁻⁵".
std::string power_label(double value);
/// Returns "0.05", or a power of ten if that is easier to read.
std::string number_label(double value);

/// Returns 1, 2 or 5 times a power of ten: the smallest of which at most `most` fit into `width` > 0.
double round_step(double width, int most);

/// Returns the multiples of round_step between low and high (low < high), both included.
std::vector<RoundTick> round_ticks(double low, double high, int most);

}  // namespace talus::pictures
