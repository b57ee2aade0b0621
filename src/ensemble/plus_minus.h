#pragma once
/// Formats a mean with its uncertainty.

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <string>

namespace talus::ensemble {

/// Formats "16.43 ± 0.21": the width, which must be positive, with two digits, and the mean with the same
/// number of decimals. `sign` adds a plus before a non-negative mean.
inline std::string plus_minus(double mean, double width, bool sign = false) {
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(width))), 0, 12);
  return fmt::format(fmt::runtime(sign ? "{0:+.{2}f} ± {1:.{2}f}" : "{0:.{2}f} ± {1:.{2}f}"), mean, width,
                     decimals);
}

}  // namespace talus::ensemble
