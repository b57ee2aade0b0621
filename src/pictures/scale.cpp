#include "pictures/scale.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/errors.h"
#include "pictures/texts.h"

namespace talus::pictures {
namespace {

constexpr double lightest_rim = 0.45;  // shade of gray
constexpr double rim_darkness = 0.6;   // factor for the channels of a colour
constexpr double dark_luma = 60.0;     // with a lower luma, a darker rim would be invisible
constexpr double rim_lightness = 0.2;  // share of white in the rim of a dark colour
constexpr int max_steps = 5;           // maximum between ticks of a bar

std::uint8_t darkened(std::uint8_t channel) { return static_cast<std::uint8_t>(rim_darkness * channel); }

std::uint8_t lightened(std::uint8_t channel) {
  return static_cast<std::uint8_t>(std::lerp(static_cast<double>(channel), 255.0, rim_lightness));
}

/// Returns ticks at these multiples of powers of ten between the ends; over many decades, at every second,
/// third, ... power. If one label has to be a power, all are.
std::vector<render::BarTick> decades(const Scale& scale, std::initializer_list<double> factors) {
  constexpr int max_decades = 10;
  constexpr double hair = 1e-9;  // tolerance that keeps ticks at the ends
  std::vector<double> values;
  const auto first = static_cast<int>(std::floor(std::log10(scale.low)));
  const auto last = static_cast<int>(std::ceil(std::log10(scale.high)));
  const int step = std::max(1, (last - first + max_decades - 1) / max_decades);
  for (int k = first; k <= last; k += step)
    for (const double factor : factors) {
      const double value = factor * std::pow(10.0, k), share = share_of(scale, value);
      if (share >= -hair && share <= 1.0 + hair) values.push_back(value);
    }
  const bool powers = std::ranges::any_of(values, needs_power);
  std::vector<render::BarTick> ticks;
  for (const double value : values)
    ticks.push_back(
        {std::clamp(share_of(scale, value), 0.0, 1.0), powers ? power_label(value) : number_label(value)});
  return ticks;
}

std::vector<render::BarTick> round_shares(const Scale& scale) {
  std::vector<render::BarTick> ticks;
  for (const RoundTick& tick : round_ticks(scale.low, scale.high, max_steps))
    ticks.push_back({std::clamp(share_of(scale, tick.value), 0.0, 1.0), tick.label});
  return ticks;
}

}  // namespace

render::Colour rim_of(const render::Colour& fill) {
  if (render::is_gray(fill)) return render::gray(std::max(1.0 - fill.red / 255.0, lightest_rim));
  const auto shade = render::luma(fill) < dark_luma ? lightened : darkened;
  return {shade(fill.red), shade(fill.green), shade(fill.blue), fill.alpha};
}

GrainStyle outline_style() { return {render::white, render::gray(0.25), false}; }

Scale chosen(Scale scale, const ScaleChoice& choice) {
  scale.colours = choice.colours.value_or(scale.colours);
  scale.low = choice.low.value_or(scale.low);
  scale.high = choice.high.value_or(scale.high);
  const std::string range = fmt::format("range {:.6g} to {:.6g}: expected ", scale.low, scale.high);
  if (!(std::isfinite(scale.low) && std::isfinite(scale.high) && scale.low < scale.high))
    throw Error(ExitCode::usage, range + "an upper end above the lower one");
  if (scale.logarithmic && !(scale.low > 0.0))
    throw Error(ExitCode::usage, range + "a positive lower end, because the scale is logarithmic");
  return scale;
}

double share_of(const Scale& scale, double value) {
  if (scale.logarithmic) return std::log(value / scale.low) / std::log(scale.high / scale.low);
  return (value - scale.low) / (scale.high - scale.low);
}

GrainStyle grain_style(const Scale& scale, double value) {
  const render::Colour fill = render::colour_at(scale.colours, share_of(scale, value));
  return {fill, rim_of(fill), !std::isnan(value)};
}

std::vector<GrainStyle> grain_styles(const Scale& scale, std::span<const double> values) {
  std::vector<GrainStyle> styles;
  styles.reserve(values.size());
  for (const double value : values) styles.push_back(grain_style(scale, value));
  return styles;
}

std::vector<GrainStyle> grain_styles_or_outlines(const Scale& scale, std::span<const double> values) {
  std::vector<GrainStyle> styles = grain_styles(scale, values);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isnan(values[i])) styles[i] = outline_style();
  return styles;
}

render::Bar bar_of(const Scale& scale, const std::string& title) {
  constexpr std::size_t few = 3;
  std::vector<render::BarTick> ticks =
      scale.logarithmic ? decades(scale, {1.0}) : std::vector<render::BarTick>();
  // A few decades also need halves and fifths; within one decade, round numbers are clearer.
  if (scale.logarithmic && ticks.size() < few) ticks = decades(scale, {1.0, 2.0, 5.0});
  if (ticks.size() < few) ticks = round_shares(scale);
  return {
      title, render::colour_ramp(scale.colours), std::move(ticks), scale.low, scale.high, scale.logarithmic};
}

}  // namespace talus::pictures
