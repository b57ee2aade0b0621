#include "page/quantised.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {
namespace {

constexpr double last_code = 65534.0;

}  // namespace

std::uint32_t code_of(const Quantum& quantum, double value) {
  if (std::isnan(value)) return no_code;
  if (quantum.logarithmic && !(value > quantum.low)) return 0;
  const double place = quantum.logarithmic ? std::log(value / quantum.low) / quantum.step
                                           : (value - quantum.low) / quantum.step;
  return static_cast<std::uint32_t>(std::lround(std::clamp(place, 0.0, last_code)));
}

double value_of(const Quantum& quantum, std::uint32_t code) {
  if (code == no_code) return std::numeric_limits<double>::quiet_NaN();
  return quantum.logarithmic ? quantum.low * std::exp(quantum.step * code)
                             : quantum.low + quantum.step * code;
}

PlaceQuantum places_of_period(double period) { return {0.0, period / 65536.0}; }

PlaceQuantum places_of_box(double low, double high) {
  return {low, high > low ? (high - low) / 65535.0 : 1.0};
}

std::uint32_t place_code(const PlaceQuantum& quantum, double place) {
  return static_cast<std::uint32_t>(std::llround((place - quantum.low) / quantum.step)) & 65535U;
}

}  // namespace talus
