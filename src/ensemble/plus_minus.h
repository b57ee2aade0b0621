#pragma once
/// A mean and its width as text.

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <string>

namespace talus::ensemble {

/// "16.43 ± 0.21": the width, above 0, with two digits, and the mean with as many decimals. `sign`: a plus
/// before a mean that is not negative.
inline std::string plus_minus(double mean, double width, bool sign = false) {
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(width))), 0, 12);
  return fmt::format(fmt::runtime(sign ? "{0:+.{2}f} ± {1:.{2}f}" : "{0:.{2}f} ± {1:.{2}f}"), mean, width,
                     decimals);
}

}  // namespace talus::ensemble
