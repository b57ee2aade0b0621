#pragma once
/// Round numbers for scales.

#include <string>
#include <vector>

namespace talus::pictures {

/// A number on a scale.
struct RoundTick {
  double value = 0.0;
  std::string label;  ///< all labels of a scale have the same number of decimals and the same power of ten
};

/// Whether a number is easier to read as a power of ten: below 0.001, and from 100 000 on.
bool needs_power(double value);
/// Returns a number > 0 with up to six digits, "2·10⁻⁵".
std::string power_label(double value);
/// Returns "0.05", or a power of ten if that is easier to read.
std::string number_label(double value);

/// Returns 1, 2 or 5 times a power of ten: the smallest such step of which at most `most` fit into `width` >
/// 0.
double round_step(double width, int most);

/// Returns the multiples of round_step between low and high (low < high), both included.
std::vector<RoundTick> round_ticks(double low, double high, int most);

}  // namespace talus::pictures
