#pragma once
/// One-parameter law for the shear stress of a bed between walls (T26).

#include <span>

#include "core/observables.h"

namespace talus::figures {

/// A bed between walls at failure.
struct WallPoint {
  double depth_over_length = 0.0;  ///< H / L
  double ratio = 0.0;              ///< (sigma_T / sigma_N) / tan(theta); 1 without walls
};

/// Fitted coefficient of the law (sigma_T / sigma_N) / tan(theta) = 1 - (k_L - k_0) / 3 * H / L.
struct WallFit {
  double k = 0.0;      ///< k_L - k_0; NaN without points
  double error = 0.0;  ///< standard error from the residuals; NaN for fewer than two points
};

/// Fits the law by least squares with equal weights.
WallFit fit_wall_law(std::span<const WallPoint> points);

/// Returns (sigma_T / sigma_N) / tan(theta) of the law.
double wall_law(double k, double depth_over_length);

}  // namespace talus::figures
