#pragma once
/// What the paper reports of its periodic bed, to stand beside what is measured.

namespace talus::paper {

/// A value at the start of the tilt, at theta_d, and at theta_c.
struct Values {
  double start, theta_d, theta_c;
};
inline constexpr Values tilt = {0.0, 15.0, 21.0};                  // deg; sections IV and V B
inline constexpr Values overloaded_fraction = {0.30, 0.45, 0.60};  // section V A, Fig. 9
inline constexpr Values mean_length = {4.0, 5.0, 7.0};             // D; section V B, Fig. 12a
inline constexpr Values largest_length = {5.0, 15.0, 30.0};        // D; Fig. 12b, the last is its cut

}  // namespace talus::paper
