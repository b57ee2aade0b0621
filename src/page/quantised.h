#pragma once
/// Numbers in 16 bits.

#include <cstdint>

namespace talus {

/// How a number becomes a code: evenly from `low` on, or, `logarithmic`, as low * exp(step * code).
struct Quantum {
  double low = 0.0;
  double step = 1.0;  ///< above 0
  bool logarithmic = false;
};

/// The code of a number that there is none of.
inline constexpr std::uint32_t no_code = 65535;

/// The nearest code; beyond the ends that of the end, which is 65534 at the top. NaN is no_code, and on a
/// logarithmic scale all that is not above `low` has code 0.
std::uint32_t code_of(const Quantum& quantum, double value);

/// What it stands for, half a quantum from the number at most; NaN for no_code.
double value_of(const Quantum& quantum, std::uint32_t code);

/// Places along a line, which have no gaps: all 65536 codes, and around a period they go on from the first.
struct PlaceQuantum {
  double low = 0.0, step = 1.0;
};
/// Of a period: 65536 steps. Of a box from low to high: 65535, so that both ends have a code.
PlaceQuantum places_of_period(double period);
PlaceQuantum places_of_box(double low, double high);
std::uint32_t place_code(const PlaceQuantum& quantum, double place);

}  // namespace talus
