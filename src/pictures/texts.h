#pragma once
/// Round numbers for scales.

#include <string>
#include <vector>

namespace talus::pictures {

/// A number on a scale.
struct RoundTick {
  double value = 0.0;
  std::string label;  ///< all of a scale have equally many decimals, and the same power of ten
};

/// Whether a number is easier to read as a power of ten: below 0.001, and from 100 000 on.
bool needs_power(double value);
/// "2·10⁻⁵": a number > 0 with up to six digits.
std::string power_label(double value);
/// "0.05", or as a power of ten where that is easier to read.
std::string number_label(double value);

/// 1, 2 or 5 times a power of ten: the smallest such step of which at most `most` fit into `width` > 0.
double round_step(double width, int most);

/// The multiples of the step of round_step between low and high (low < high), both included.
std::vector<RoundTick> round_ticks(double low, double high, int most);

}  // namespace talus::pictures
