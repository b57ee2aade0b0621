#include "stress/overload.h"

#include <cmath>

namespace talus::stress {

OverloadCount count_overloaded(const BedFrame& bed, double gamma_c) {
  OverloadCount count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(bed.statics.free_count); ++i) {
    if (!std::isnan(bed.frame.gamma[i])) ++count.loaded;
    if (is_overloaded(bed.frame.gamma[i], gamma_c)) ++count.overloaded;
  }
  return count;
}

}  // namespace talus::stress
