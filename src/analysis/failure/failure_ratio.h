#pragma once
/// How far the shear stress of a packing stays below that of an infinite slope, just before it fails.

#include <span>

namespace talus::analysis {

/// deg before theta_c, the window of failure_ratio in analyses.
inline constexpr double failure_window = 0.5;

/// (sigma_T / sigma_N) / tan(theta): 1 for a periodic bed, less between walls (paper, Eq. 15 and Fig. 7).
struct FailureRatio {
  double mean = 0.0;
  double spread = 0.0;  ///< standard deviation in the window; NaN for fewer than two values
};

/// Over the last `window` (rad) before theta_c (rad). `tilts` (rad) and `ratios`, sigma_T / sigma_N, row by
/// row. NaN where the slope has not failed.
FailureRatio failure_ratio(std::span<const double> tilts, std::span<const double> ratios, double theta_c,
                           double window);

}  // namespace talus::analysis
