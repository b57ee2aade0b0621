#include "pictures/texts.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace talus {

double round_step(double width, int most) {
  const double decade = std::pow(10.0, std::floor(std::log10(width / most)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (width <= factor * decade * most * (1.0 + 1e-9)) return factor * decade;
  return 10.0 * decade;
}

std::vector<RoundTick> round_ticks(double low, double high, int most) {
  const double step = round_step(high - low, most);
  // A hair, so that rounding loses no tick at an end.
  const auto first = static_cast<long>(std::ceil(low / step - 1e-6));
  const auto last = static_cast<long>(std::floor(high / step + 1e-6));
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  std::vector<RoundTick> ticks;
  for (long k = first; k <= last; ++k) {
    const double value = static_cast<double>(k) * step;
    std::string label = fmt::format("{:.{}f}", std::fabs(value), decimals);
    ticks.push_back({value, k < 0 ? "−" + label : label});
  }
  return ticks;
}

}  // namespace talus
