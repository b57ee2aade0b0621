#include "core/snapshot.h"

namespace talus {

RunStatics arrived_statics(const RunStatics& all, Index count) {
  RunStatics statics = all;
  const Index waiting = static_cast<Index>(all.radius.size()) - count;
  statics.free_count -= waiting;
  for (std::vector<double>* values : {&statics.radius, &statics.mass})
    values->erase(values->begin() + statics.free_count, values->begin() + all.free_count);
  return statics;
}

}  // namespace talus
