#include "maps/scale.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "maps/texts.h"

namespace talus {
namespace {

constexpr double lightest_rim = 0.45;  // shade of gray
constexpr double rim_darkness = 0.6;   // of the channels of a colour
constexpr int most_steps = 5;          // between ticks of a bar

std::uint8_t darkened(std::uint8_t channel) { return static_cast<std::uint8_t>(rim_darkness * channel); }

std::vector<BarTick> decades(const Scale& scale) {
  std::vector<BarTick> ticks;
  const auto first = static_cast<int>(std::ceil(std::log10(scale.low) - 1e-9));
  const auto last = static_cast<int>(std::floor(std::log10(scale.high) + 1e-9));
  for (int k = first; k <= last; ++k) {
    const double value = std::pow(10.0, k);
    ticks.push_back({std::clamp(share_of(scale, value), 0.0, 1.0), brief_text(value)});
  }
  return ticks;
}

std::vector<BarTick> round_shares(const Scale& scale) {
  std::vector<BarTick> ticks;
  for (const RoundTick& tick : round_ticks(scale.low, scale.high, most_steps))
    ticks.push_back({std::clamp(share_of(scale, tick.value), 0.0, 1.0), tick.label});
  return ticks;
}

}  // namespace

Colour rim_of(const Colour& fill) {
  if (is_gray(fill)) return gray(std::max(1.0 - fill.red / 255.0, lightest_rim));
  return {darkened(fill.red), darkened(fill.green), darkened(fill.blue), fill.alpha};
}

GrainLook outline_look() { return {white, gray(0.25), false}; }

Scale chosen(Scale scale, const ScaleChoice& choice) {
  scale.colours = choice.colours.value_or(scale.colours);
  scale.low = choice.low.value_or(scale.low);
  scale.high = choice.high.value_or(scale.high);
  const std::string range =
      "range " + brief_text(scale.low) + " to " + brief_text(scale.high) + ": expected ";
  if (!(std::isfinite(scale.low) && std::isfinite(scale.high) && scale.low < scale.high))
    throw Error(ExitCode::usage, range + "an end above the beginning");
  if (scale.logarithmic && !(scale.low > 0.0))
    throw Error(ExitCode::usage, range + "a beginning above 0, as the scale is logarithmic");
  return scale;
}

double share_of(const Scale& scale, double value) {
  if (scale.logarithmic) return std::log(value / scale.low) / std::log(scale.high / scale.low);
  return (value - scale.low) / (scale.high - scale.low);
}

GrainLook look_of(const Scale& scale, double value) {
  const Colour fill = colour_at(scale.colours, share_of(scale, value));
  return {fill, rim_of(fill), !std::isnan(value)};
}

std::vector<GrainLook> looks_of(const Scale& scale, std::span<const double> values) {
  std::vector<GrainLook> looks;
  looks.reserve(values.size());
  for (const double value : values) looks.push_back(look_of(scale, value));
  return looks;
}

Bar bar_of(const Scale& scale, const std::string& title) {
  std::vector<BarTick> ticks = scale.logarithmic ? decades(scale) : std::vector<BarTick>();
  // Within one decade round numbers say more.
  if (ticks.size() < 2) ticks = round_shares(scale);
  return {title, colour_ramp(scale.colours), std::move(ticks)};
}

}  // namespace talus
