#include <algorithm>

#include "exports/writers.h"

namespace talus::exports {

BedBounds bed_bounds(const analysis::GrainSource& of) {
  const RunStatics& statics = of.statics;
  const double half = 0.5 * statics.mean_diameter;
  BedBounds bounds = {0.0, statics.length, 0.0, 0.0, -half, half};
  for (std::size_t i = 0; i < of.frame.y.size(); ++i) {
    bounds.y_low = std::min(bounds.y_low, of.frame.y[i] - statics.radius[i]);
    bounds.y_high = std::max(bounds.y_high, of.frame.y[i] + statics.radius[i]);
  }
  return bounds;
}

}  // namespace talus::exports
