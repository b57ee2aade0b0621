#include "core/trigonometry.h"

#include <cmath>

namespace talus {
namespace {

/// Returns the Taylor series of sin(x)/x or cos(x) in x^2, summed from the smallest term. `first` is the
/// first factor in the denominators: 2 for the sine (2*3, 4*5, ...) and 1 for the cosine (1*2, 3*4, ...).
double alternating_series(double square, int first) {
  constexpr int terms = 13;  // the 13th term at pi/2 is below 1e-18
  double sum = 1.0;
  for (int k = terms; k >= 1; --k) {
    const double denominator =
        static_cast<double>(2 * k - 2 + first) * static_cast<double>(2 * k - 1 + first);
    sum = 1.0 - square / denominator * sum;
  }
  return sum;
}

}  // namespace

double rounded_degrees(double radians) {
  constexpr double per_degree = 1e9;
  return std::nearbyint(degrees(radians) * per_degree) / per_degree + 0.0;
}

double sine(double angle) { return angle * alternating_series(angle * angle, 2); }

double cosine(double angle) { return alternating_series(angle * angle, 1); }

double arctangent(double slope) {
  constexpr int halvings = 3;  // reduce the angle to at most pi/16
  constexpr int terms = 12;    // slope^(2 k) / (2 k + 1) is then below 1e-18 for k = 12
  for (int k = 0; k < halvings; ++k) slope /= 1.0 + std::sqrt(1.0 + slope * slope);
  const double square = slope * slope;
  double sum = 0.0;
  for (int k = terms; k >= 1; --k) sum = square * (1.0 / (2 * k + 1) - sum);
  return (1 << halvings) * (slope - slope * sum);
}

}  // namespace talus
