#include "pictures/texts.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace talus::pictures {
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
