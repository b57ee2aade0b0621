#include "analysis/contact_network.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/clusters.h"
#include "analysis/free_grains.h"
#include "stress/stress_state.h"

namespace talus {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double mean_normal_force(const FrameContacts& contacts) {
  double sum = 0.0;
  for (double fn : contacts.fn) sum += fn;
  return contacts.count() > 0 ? sum / contacts.count() : nan;
}

/// Calls visit(id) for the free grains at a contact.
template <typename Visit>
void for_each_free_end(const Frame& frame, const RunStatics& statics, Index c, const Visit& visit) {
  if (frame.contacts.a[c] < statics.free_count) visit(frame.contacts.a[c]);
  if (frame.contacts.b[c] < statics.free_count) visit(frame.contacts.b[c]);
}

/// Which free grains are no rattlers, and the contacts that these have among themselves and with what is
/// fixed.
struct Backbone {
  std::vector<bool> grain;
  std::vector<Index> degree;  ///< no longer right for a rattler
};

Backbone find_backbone(const Frame& frame, const RunStatics& statics) {
  const auto count = static_cast<std::size_t>(statics.free_count);
  Backbone backbone{std::vector<bool>(count, true), std::vector<Index>(count, 0)};
  std::vector<std::vector<Index>> contacts_of(count);
  for (Index c = 0; c < frame.contacts.count(); ++c)
    for_each_free_end(frame, statics, c, [&](Index i) {
      contacts_of[i].push_back(c);
      ++backbone.degree[i];
    });
  std::vector<Index> loose;
  for (Index i = 0; i < statics.free_count; ++i)
    if (backbone.degree[i] < 2) loose.push_back(i);
  while (!loose.empty()) {
    const Index i = loose.back();
    loose.pop_back();
    if (!backbone.grain[i]) continue;
    backbone.grain[i] = false;
    for (Index c : contacts_of[i])
      for_each_free_end(frame, statics, c, [&](Index j) {
        if (--backbone.degree[j] < 2 && backbone.grain[j]) loose.push_back(j);
      });
  }
  return backbone;
}

/// Part of contact c in the sum of the internal moments of the free grains: branch vector times force.
void add_moment(const Frame& frame, const RunStatics& statics, Index c, Tensor2& sum) {
  const FrameContacts& contacts = frame.contacts;
  double branch = 0.0;  // along the normal, from centre to contact and on to the other centre
  if (contacts.a[c] < statics.free_count) branch += statics.radius[contacts.a[c]];
  if (contacts.b[c] < statics.free_count) branch += statics.radius[contacts.b[c]];
  const double nx = contacts.nx[c];
  const double ny = contacts.ny[c];
  const double fx = contacts.fn[c] * nx - contacts.ft[c] * ny;
  const double fy = contacts.fn[c] * ny + contacts.ft[c] * nx;
  sum.xx += branch * nx * fx;
  sum.xy += branch * nx * fy;
  sum.yx += branch * ny * fx;
  sum.yy += branch * ny * fy;
}

/// Scalar product of the deviators of the symmetric parts of two tensors, up to a factor.
double deviator_product(const Tensor2& one, const Tensor2& other) {
  return (one.xx - one.yy) * (other.xx - other.yy) + (one.xy + one.yx) * (other.xy + other.yx);
}

}  // namespace

Coordination coordination(const Frame& frame, const RunStatics& statics) {
  std::vector<Index> degree(static_cast<std::size_t>(statics.free_count), 0);
  for (Index c = 0; c < frame.contacts.count(); ++c)
    for_each_free_end(frame, statics, c, [&](Index i) { ++degree[i]; });
  Index ends = 0, carrying = 0;
  for (Index each : degree) {
    ends += each;
    carrying += each > 0 ? 1 : 0;
  }
  const Backbone backbone = find_backbone(frame, statics);
  Index backbone_ends = 0, in_backbone = 0;
  for (std::size_t i = 0; i < degree.size(); ++i)
    if (backbone.grain[i]) {
      backbone_ends += backbone.degree[i];
      ++in_backbone;
    }
  const auto ratio = [](Index above, Index below) {
    return below > 0 ? static_cast<double>(above) / below : 0.0;
  };
  return {ratio(ends, carrying), ratio(ends, statics.free_count), ratio(backbone_ends, in_backbone),
          ratio(statics.free_count - in_backbone, statics.free_count)};
}

Histogram normal_forces(const Frame& frame, Histogram bins) {
  const double mean = mean_normal_force(frame.contacts);
  for (double fn : frame.contacts.fn) bins.add(fn / mean);
  return bins;
}

Histogram mobilised_friction(const Frame& frame, const RunStatics& statics, int bins) {
  Histogram histogram(0.0, 1.0, bins);
  for (Index c = 0; c < frame.contacts.count(); ++c)
    histogram.add(std::min(1.0, std::fabs(frame.contacts.ft[c]) / (statics.friction * frame.contacts.fn[c])));
  return histogram;
}

Networks networks(const Frame& frame, const RunStatics& statics) {
  Networks result;
  result.mean_normal_force = mean_normal_force(frame.contacts);
  Tensor2 strong, weak;
  Index strong_count = 0;
  for (Index c = 0; c < frame.contacts.count(); ++c) {
    const bool is_strong = frame.contacts.fn[c] > result.mean_normal_force;
    strong_count += is_strong ? 1 : 0;
    add_moment(frame, statics, c, is_strong ? strong : weak);
  }
  Tensor2 all = strong;
  add_to(all, weak);
  result.strong_share =
      frame.contacts.count() > 0 ? static_cast<double>(strong_count) / frame.contacts.count() : nan;
  result.strong_share_of_mean = (strong.xx + strong.yy) / (all.xx + all.yy);
  result.strong_share_of_deviator = deviator_product(strong, all) / deviator_product(all, all);
  result.strong_ratio = stress_state(strong).ratio;
  result.weak_ratio = stress_state(weak).ratio;
  return result;
}

CriticalContacts critical_contacts(const Frame& frame, const RunStatics& statics) {
  const FrameContacts& contacts = frame.contacts;
  std::vector<bool> touched(static_cast<std::size_t>(statics.free_count), false);
  std::vector<Link> links;
  Index critical = 0;
  for (Index c = 0; c < contacts.count(); ++c) {
    if (contacts.status[c] != ContactStatus::sliding) continue;
    ++critical;
    for_each_free_end(frame, statics, c, [&](Index i) { touched[i] = true; });
    if (contacts.a[c] < statics.free_count && contacts.b[c] < statics.free_count)
      links.push_back({contacts.a[c], contacts.b[c], contacts.shift[c]});
  }
  const Clusters clusters = find_clusters(touched, links, frame.x, period_of(statics));
  std::vector<Index> size(clusters.size.size(), 0);
  for (Index c = 0; c < contacts.count(); ++c)
    if (contacts.status[c] == ContactStatus::sliding) ++size[clusters.label[contacts.a[c]]];
  CriticalContacts result;
  result.share = contacts.count() > 0 ? static_cast<double>(critical) / contacts.count() : nan;
  result.largest_cluster = size.empty() ? 0 : *std::max_element(size.begin(), size.end());
  result.correlation_length = correlation_length(clusters, frame.y);
  return result;
}

}  // namespace talus
