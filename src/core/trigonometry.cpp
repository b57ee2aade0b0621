#include "core/trigonometry.h"

namespace talus {
namespace {

/// Taylor series of sin(x)/x or cos(x) in x^2, summed from the smallest term: `first` is the index of the
/// first factor in the denominators, 2 for the sine (2*3, 4*5, ...) and 1 for the cosine (1*2, 3*4, ...).
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

double sine(double angle) { return angle * alternating_series(angle * angle, 2); }

double cosine(double angle) { return alternating_series(angle * angle, 1); }

}  // namespace talus
