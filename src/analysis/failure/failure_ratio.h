#pragma once
/// Ratio of the shear stress of a packing to that of an infinite slope, just before failure.

#include <span>

namespace talus::analysis {

/// Window before theta_c that analyses use for failure_ratio, deg.
inline constexpr double failure_window = 0.5;

/// (sigma_T / sigma_N) / tan(theta): 1 for a periodic bed, less between walls (paper, Eq. 15 and Fig. 7).
struct FailureRatio {
  double mean = 0.0;
  double spread = 0.0;  ///< standard deviation in the window; NaN for fewer than two values
};

/// Averages over the last `window` (rad) before theta_c (rad). `tilts` (rad) and `ratios`, sigma_T / sigma_N,
/// correspond row by row. NaN if the slope has not failed.
FailureRatio failure_ratio(std::span<const double> tilts, std::span<const double> ratios, double theta_c,
                           double window);

}  // namespace talus::analysis
