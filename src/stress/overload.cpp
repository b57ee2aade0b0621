#include "stress/overload.h"

#include <cmath>

namespace talus {

OverloadCount count_overloaded(const Frame& frame, const RunStatics& statics, double gamma_c) {
  OverloadCount count;
  for (std::size_t i = 0; i < static_cast<std::size_t>(statics.free_count); ++i) {
    if (!std::isnan(frame.gamma[i])) ++count.loaded;
    if (is_overloaded(frame.gamma[i], gamma_c)) ++count.overloaded;
  }
  return count;
}

}  // namespace talus
