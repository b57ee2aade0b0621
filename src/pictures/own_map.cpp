/// A map of values that a script has computed.

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <iterator>
#include <set>

#include "base/errors.h"
#include "base/text.h"
#include "pictures/layers.h"
#include "render/font.h"

namespace talus::pictures {
namespace {

using Kind = OwnQuantity::Kind;

/// Returns the range of the values and of those in the settings, about 0 if they have both signs.
Scale scale_of(const OwnQuantity& own, const MapSettings& settings) {
  constexpr double largest = 1e100;
  std::vector<double> ends = ends_of(own.values);
  ends.insert(ends.end(), settings.own->values.begin(), settings.own->values.end());
  double low = ends.empty() ? 0.0 : std::ranges::min(ends),
         high = ends.empty() ? 0.0 : std::ranges::max(ends);
  const bool has_both_signs = low < 0.0 && high > 0.0;
  if (has_both_signs) {
    high = std::max(high, -low);
    low = -high;
  } else if (low == high) {
    const double margin = low == 0.0 ? 1.0 : 0.5 * std::abs(low);
    low -= margin;
    high += margin;
  }
  const Scale scale =
      chosen({has_both_signs ? render::ColourMap::diverging : render::ColourMap::viridis, low, high},
             {settings.colours, settings.range_low, settings.range_high});
  if (std::max(std::abs(scale.low), std::abs(scale.high)) > largest || scale.high - scale.low < 1.0 / largest)
    throw Error(ExitCode::usage, "values from {:.6g} to {:.6g}: no scale shows these; use another unit",
                scale.low, scale.high);
  return scale;
}

/// Returns the colour of a value; none for a number that is not finite and for a label below 0.
std::optional<render::Colour> colour_of(double value, const OwnQuantity& own, const Scale& scale,
                                        const std::vector<render::Colour>& palette) {
  if (own.kind == Kind::flag) return value != 0.0 ? render::black : render::white;
  if (!std::isfinite(value) || (own.kind == Kind::cluster && value < 0.0)) return std::nullopt;
  if (own.kind == Kind::number) return render::colour_at(scale.colours, share_of(scale, value));
  return palette[static_cast<std::size_t>(std::fmod(value, static_cast<double>(palette.size())))];
}

std::string title_of(const OwnQuantity& own, const char* what) {
  if (own.kind == Kind::flag) {
    const auto count = std::ranges::count_if(own.values, [](double value) { return value != 0.0; });
    const double all = std::max(1.0, static_cast<double>(own.values.size()));
    return fmt::format("{}, {:.1f} % of {}", own.label, 100.0 * static_cast<double>(count) / all, what);
  }
  if (own.kind == Kind::number) return own.label;
  std::set<double> labels(own.values.begin(), own.values.end());
  std::erase_if(labels, [](double label) { return label < 0.0; });
  return fmt::format("{}, {}", own.label, counted(labels.size(), "cluster"));
}

}  // namespace

void check_text(const std::string& what, const std::string& text) {
  if (!render::can_be_set(render::embedded_font(), text))
    throw Error(
        ExitCode::usage,
        "{} {}: pictures support only Latin-1 letters (in UTF-8), some Greek letters and common signs", what,
        visible_word(text));
}

std::vector<double> ends_of(std::span<const double> values) {
  std::vector<double> finite;
  std::ranges::copy_if(values, std::back_inserter(finite), [](double value) { return std::isfinite(value); });
  if (finite.empty()) return {};
  const auto [low, high] = std::ranges::minmax(finite);
  return {low, high};
}

MapLayer own_layer(const analysis::GrainSource& frame, const MapSettings& settings) {
  const auto found = std::ranges::find(frame.frame.own, settings.own->name, &OwnQuantity::name);
  if (found == frame.frame.own.end())
    throw Error(ExitCode::bad_data, "the frame has no values of {}", settings.own->name);
  const OwnQuantity& own = *found;
  check_text("label", own.label);
  check_text("unit", own.unit);
  const bool of_grains = own.of_grains;
  OwnQuantity shown = own;
  if (of_grains) shown.values.resize(static_cast<std::size_t>(frame.statics.free_count));
  const Scale scale = scale_of(shown, settings);
  const std::vector<render::Colour> palette = cluster_palette(settings.palette);
  MapLayer layer;
  layer.title = title_of(shown, of_grains ? "grains" : "contacts");
  bool is_complete = true;  // every grain or contact has a colour
  for (std::size_t k = 0; k < shown.values.size(); ++k) {
    const auto colour = colour_of(shown.values[k], shown, scale, palette);
    is_complete = is_complete && colour;
    if (of_grains) {
      layer.styles.push_back(colour ? GrainStyle{*colour, rim_of(*colour)} : outline_style());
    } else if (colour && (own.kind != Kind::flag || shown.values[k] != 0.0)) {
      layer.lines.push_back(centre_line(frame, static_cast<Index>(k),
                                        2.0 * force_lines.half_width * frame.statics.mean_diameter, *colour));
    }
  }
  const auto swatch = [&](const GrainStyle& style, const std::string& label) {
    using enum render::Swatch::Kind;
    layer.legend.swatches.push_back({of_grains ? disc : line, style.fill, style.rim, 0.35, label});
  };
  if (own.kind == Kind::number) {
    layer.legend.bars = {bar_of(scale, own.unit.empty() ? own.label : own.label + " (" + own.unit + ")")};
    if (of_grains) layer.legend.bars[0].values = shown.values;
    layer.legend.bars[0].symbol = own.label;
    layer.legend.bars[0].unit = own.unit;
    if (!is_complete && of_grains) swatch(outline_style(), "no value");
  } else if (own.kind == Kind::flag) {
    swatch({render::black, render::black}, own.label);
    if (of_grains) swatch({render::white, rim_of(render::white)}, "others");
  } else if (!is_complete && of_grains) {
    swatch(outline_style(), "in none");
  }
  return layer;
}

}  // namespace talus::pictures
