#include "core/snapshot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace talus {

bool is_with_wall(const Frame& frame, Index c) {
  const std::size_t k = c;
  return frame.contacts.b[k] >= frame.grain_count() && std::abs(frame.contacts.nx[k]) > 0.5;
}

double friction_of_contact(const Frame& frame, Index c) {
  return is_with_wall(frame, c) ? frame.friction.walls : frame.friction.grains;
}

double force_threshold(std::span<const double> mass, Index free_count, double gravity) {
  if (free_count <= 0) return std::numeric_limits<double>::infinity();
  const auto free = mass.first(free_count);
  return 1e-9 * gravity * std::accumulate(free.begin(), free.end(), 0.0) / free_count;
}

double force_threshold(const RunStatics& statics) {
  return force_threshold(statics.mass, statics.free_count, statics.gravity);
}

void remove_open_contacts(Frame& frame, double threshold) {
  FrameContacts& contacts = frame.contacts;
  if (std::ranges::none_of(contacts.fn, [&](double fn) { return fn < threshold; })) return;
  const std::vector<double> force = contacts.fn;
  const auto keep_loaded = [&](auto& values) {
    std::size_t kept = 0;
    for (std::size_t c = 0; c < values.size(); ++c)
      if (!(force[c] < threshold)) values[kept++] = values[c];
    values.resize(kept);
  };
  for (auto* numbers :
       {&contacts.nx, &contacts.ny, &contacts.px, &contacts.py, &contacts.fn, &contacts.ft, &contacts.moment})
    keep_loaded(*numbers);
  for (OwnQuantity& own : frame.own)
    if (!own.of_grains) keep_loaded(own.values);
  keep_loaded(contacts.a);
  keep_loaded(contacts.b);
  keep_loaded(contacts.shift);
  keep_loaded(contacts.status);
  clear_unloaded_grains(frame);
}

void clear_unloaded_grains(Frame& frame) {
  std::vector<bool> touched(frame.gamma.size(), false);
  for (const auto* bodies : {&frame.contacts.a, &frame.contacts.b})
    for (const Index body : *bodies)
      if (body < frame.grain_count()) touched[body] = true;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    if (touched[i]) continue;
    frame.gamma[i] = not_known;
    if (Tensor2& moment = frame.internal_moment[i]; moment.xx + moment.yy > 0.0) moment = {};
  }
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
