#include "core/snapshot.h"

#include <cmath>

namespace talus {

bool is_with_wall(const Frame& frame, Index c) {
  const auto k = static_cast<std::size_t>(c);
  return frame.contacts.b[k] >= frame.grain_count() && std::abs(frame.contacts.nx[k]) > 0.5;
}

double friction_of_contact(const Frame& frame, Index c) {
  return is_with_wall(frame, c) ? frame.friction.walls : frame.friction.grains;
}

RunStatics arrived_statics(const RunStatics& all, Index count) {
  RunStatics statics = all;
  const Index waiting = static_cast<Index>(all.radius.size()) - count;
  statics.free_count -= waiting;
  for (std::vector<double>* values : {&statics.radius, &statics.mass})
    values->erase(values->begin() + statics.free_count, values->begin() + all.free_count);
  return statics;
}

}  // namespace talus
