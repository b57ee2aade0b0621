#include <algorithm>

#include "exports/writers.h"

namespace talus::exports {

BedBounds bed_bounds(const analysis::GrainSource& source) {
  const RunStatics& statics = source.statics;
  const double half = 0.5 * statics.mean_diameter;
  BedBounds bounds = {0.0, statics.length, 0.0, 0.0, -half, half};
  for (std::size_t i = 0; i < source.frame.y.size(); ++i) {
    bounds.y_low = std::min(bounds.y_low, source.frame.y[i] - statics.radius[i]);
    bounds.y_high = std::max(bounds.y_high, source.frame.y[i] + statics.radius[i]);
  }
  return bounds;
}

}  // namespace talus::exports
