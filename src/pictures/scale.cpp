#include "pictures/scale.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/errors.h"

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

std::vector<GrainStyle> grain_styles(const Scale& scale, std::span<const double> values, bool outlines) {
  std::vector<GrainStyle> styles;
  styles.reserve(values.size());
  for (const double value : values)
    styles.push_back(outlines && std::isnan(value) ? outline_style() : grain_style(scale, value));
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

namespace {

/// Returns an exponent such as "⁻¹²".
std::string superscript(int exponent) {
  static constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : fmt::format("{}", std::abs(exponent))) text += digits[digit - '0'];
  return text;
}

/// Returns a number times a power of ten, "2·10⁻⁵", from a formatted factor.
std::string times_power(const std::string& factor, int exponent) {
  return (factor == "1" ? "10" : factor + "·10") + superscript(exponent);
}

std::string with_minus(bool negative, const std::string& text) { return negative ? "−" + text : text; }

int decade_of(double value) { return static_cast<int>(std::floor(std::log10(value) + 1e-9)); }

}  // namespace

bool needs_power(double value) {
  constexpr double smallest = 1e-3, largest = 1e5;
  const double size = std::fabs(value);
  return size > 0.0 && (size < smallest * (1.0 - 1e-9) || size >= largest * (1.0 - 1e-9));
}

std::string power_label(double value) {
  const int decade = decade_of(value);
  return times_power(fmt::format("{:.6g}", value / std::pow(10.0, decade)), decade);
}

std::string number_label(double value) {
  const double size = std::fabs(value);
  return with_minus(value < 0.0, needs_power(value) ? power_label(size) : fmt::format("{:.6g}", size));
}

double round_step(double width, int most) {
  const double decade = std::pow(10.0, std::floor(std::log10(width / most)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (width <= factor * decade * most * (1.0 + 1e-9)) return factor * decade;
  return 10.0 * decade;
}

std::vector<RoundTick> round_ticks(double low, double high, int most) {
  const double step = round_step(high - low, most);
  // The tolerance keeps ticks at the ends despite rounding.
  const auto first = static_cast<long>(std::ceil(low / step - 1e-6));
  const auto last = static_cast<long>(std::floor(high / step + 1e-6));
  const int decimals = std::max(0, -decade_of(step));
  // Numbers of seven digits, or with three or more zeros after the point, are written as powers of ten.
  constexpr double smallest = 1e-3, largest = 1e6;
  const double size = std::max(std::fabs(low), std::fabs(high));
  const bool powers = size >= largest || size < smallest;
  const int decade = powers ? decade_of(size) : 0;
  std::vector<RoundTick> ticks;
  for (long k = first; k <= last; ++k) {
    const double value = static_cast<double>(k) * step;
    std::string label = fmt::format("{:.{}f}", std::fabs(value), decimals);
    if (powers && k == 0) label = "0";
    if (powers && k != 0)
      label = times_power(fmt::format("{:.{}f}", std::fabs(value) / std::pow(10.0, decade),
                                      std::max(0, decade - decade_of(step))),
                          decade);
    ticks.push_back({value, with_minus(k < 0, label)});
  }
  return ticks;
}

}  // namespace talus::pictures
