#include "analysis/failure/failure_distance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/free_grains.h"
#include "core/statistics.h"
#include "core/trigonometry.h"

namespace talus::analysis {

std::vector<ForceCount> count_forces(const BedFrame& bed, double height, int layers) {
  const FrameContacts& contacts = bed.frame.contacts;
  std::vector<ForceCount> counts(layers);
  std::vector<bool> carries(bed.statics.free_count, false);
  std::vector<bool> turns = carries;
  const auto layer_of = [&](Index i) -> ForceCount& {
    const auto layer = static_cast<int>(std::clamp(bed.frame.y[i] / height * layers, 0.0, layers - 1.0));
    return counts[layer];
  };
  for (Index c = 0; c < contacts.count(); ++c) {
    const bool is_shared = contacts.a[c] < bed.statics.free_count && contacts.b[c] < bed.statics.free_count;
    const double part = is_shared ? 0.5 : 1.0;
    const bool has_friction = friction_of_contact(bed.frame, c) > 0.0;
    for_each_free_end(bed, c, [&](Index i) {
      ForceCount& count = layer_of(i);
      count.contacts += part;
      if (contacts.status[c] == ContactStatus::sliding) count.critical += part;
      if (!carries[i]) count.grains += 1.0;
      carries[i] = true;
      if (has_friction && !turns[i]) count.turning += 1.0;
      turns[i] = turns[i] || has_friction;
    });
  }
  return counts;
}

void measure_failure_distance(const BedFrame& bed, double height, FrameRecord& record) {
  ForceCount whole;
  const bool is_bounded = bed.frame.contacts.moment.empty();
  for (const ForceCount& layer : count_forces(bed, height, critical_layers)) {
    record.layer_critical_share.push_back(layer.share());
    record.layer_critical_share_of_bound.push_back(is_bounded ? layer.share_of_bound() : not_known);
    whole.grains += layer.grains;
    whole.turning += layer.turning;
    whole.contacts += layer.contacts;
    whole.critical += layer.critical;
  }
  if (!is_bounded) return;
  record.critical_bound = whole.bound();
  record.critical_share_of_bound = whole.share_of_bound();
}

Statistics failure_ratio(std::span<const double> tilts, std::span<const double> ratios, double theta_c,
                         double window) {
  std::vector<double> found;
  for (std::size_t k = 0; k < tilts.size(); ++k)
    if (tilts[k] > 0.0 && tilts[k] <= theta_c && tilts[k] > theta_c - window)
      found.push_back(ratios[k] * cosine(tilts[k]) / sine(tilts[k]));
  return statistics_of(found);
}

}  // namespace talus::analysis
