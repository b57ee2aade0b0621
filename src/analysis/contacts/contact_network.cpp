#include "analysis/contacts/contact_network.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <iterator>
#include <numeric>

#include "analysis/free_grains.h"
#include "analysis/overload/clusters.h"
#include "analysis/texture/texture.h"
#include "base/errors.h"
#include "core/tensor.h"
#include "core/trigonometry.h"
#include "stress/stress.h"

namespace talus::analysis {

namespace {

double mean_normal_force(const FrameContacts& contacts) {
  double sum = 0.0;
  for (double fn : contacts.fn) sum += fn;
  return contacts.count() > 0 ? sum / contacts.count() : not_known;
}

/// The free grains that are not rattlers, and their numbers of contacts with one another and with fixed
/// bodies.
struct Backbone {
  std::vector<bool> grain;
  std::vector<Index> degree;  ///< not valid for rattlers
};

/// Removes rattlers repeatedly. `degree`: the number of contacts of each free grain.
Backbone find_backbone(const BedFrame& bed, const std::vector<Index>& degree) {
  Backbone backbone{std::vector<bool>(degree.size(), true), degree};
  std::vector<std::vector<Index>> contacts_of(degree.size());
  for (Index c = 0; c < bed.frame.contacts.count(); ++c)
    for_each_free_end(bed, c, [&](Index i) { contacts_of[i].push_back(c); });
  std::vector<Index> loose;
  for (Index i = 0; i < bed.statics.free_count; ++i)
    if (backbone.degree[i] < 2) loose.push_back(i);
  while (!loose.empty()) {
    const Index i = loose.back();
    loose.pop_back();
    if (!backbone.grain[i]) continue;
    backbone.grain[i] = false;
    for (Index c : contacts_of[i])
      for_each_free_end(bed, c, [&](Index j) {
        if (--backbone.degree[j] < 2 && backbone.grain[j]) loose.push_back(j);
      });
  }
  return backbone;
}

/// Returns the scalar product of the deviators of the symmetric parts of two tensors, up to a factor.
double deviator_product(const Tensor2& one, const Tensor2& other) {
  return (one.xx - one.yy) * (other.xx - other.yy) + (one.xy + one.yx) * (other.xy + other.yx);
}

}  // namespace

double mobilisation_of(const BedFrame& bed, Index c) {
  const double allowed = friction_of_contact(bed.frame, c) * bed.frame.contacts.fn[c];
  return allowed > 0.0 ? std::min(1.0, std::fabs(bed.frame.contacts.ft[c]) / allowed) : 1.0;
}

void measure_coordination(const BedFrame& bed, FrameRecord& record) {
  const FrameContacts& contacts = bed.frame.contacts;
  const std::vector<Index> degree =
      stress::contacts_of_grains(contacts.a, contacts.b, bed.statics.free_count);
  const Index ends = std::accumulate(degree.begin(), degree.end(), Index{0});
  const Backbone backbone = find_backbone(bed, degree);
  Index backbone_ends = 0, in_backbone = 0;
  for (std::size_t i = 0; i < degree.size(); ++i)
    if (backbone.grain[i]) {
      backbone_ends += backbone.degree[i];
      ++in_backbone;
    }
  const auto ratio = [](Index above, Index below) {
    return below > 0 ? static_cast<double>(above) / below : 0.0;
  };
  record.coordination_number = stress::coordination_number(degree);
  record.coordination_number_of_all = ratio(ends, bed.statics.free_count);
  record.coordination_number_without_rattlers = ratio(backbone_ends, in_backbone);
  record.rattler_fraction = ratio(bed.statics.free_count - in_backbone, bed.statics.free_count);
}

Histogram normal_forces(const Frame& frame, Histogram bins) {
  const double mean = mean_normal_force(frame.contacts);
  for (double fn : frame.contacts.fn) bins.add(fn / mean);
  return bins;
}

Histogram mobilised_friction(const BedFrame& bed, int bins) {
  Histogram histogram(0.0, 1.0, bins);
  for (Index c = 0; c < bed.frame.contacts.count(); ++c) histogram.add(mobilisation_of(bed, c));
  return histogram;
}

std::vector<double> mobilised_friction_of_grains(const BedFrame& bed) {
  const std::size_t count = bed.statics.free_count;
  std::vector<double> sum(count, 0.0), contacts(count, 0.0);
  for (Index c = 0; c < bed.frame.contacts.count(); ++c)
    for_each_free_end(bed, c, [&](Index i) {
      sum[i] += mobilisation_of(bed, c);
      contacts[i] += 1.0;
    });
  for (std::size_t i = 0; i < count; ++i) sum[i] = contacts[i] > 0.0 ? sum[i] / contacts[i] : not_known;
  return sum;
}

void measure_networks(const BedFrame& bed, FrameRecord& record) {
  record.mean_normal_force = mean_normal_force(bed.frame.contacts);
  Tensor2 strong, weak;
  Index strong_count = 0;
  std::vector<double> in_strong, in_weak;
  for (Index c = 0; c < bed.frame.contacts.count(); ++c) {
    const bool is_strong = bed.frame.contacts.fn[c] > record.mean_normal_force;
    strong_count += is_strong ? 1 : 0;
    add_moment(bed, c, is_strong ? strong : weak);
    in_strong.push_back(is_strong ? 1.0 : 0.0);
    in_weak.push_back(is_strong ? 0.0 : 1.0);
  }
  Tensor2 all = strong;
  add_to(all, weak);
  record.strong_share = bed.frame.contacts.count() > 0
                            ? static_cast<double>(strong_count) / bed.frame.contacts.count()
                            : not_known;
  record.strong_share_of_mean_stress = matrix(strong).trace() / matrix(all).trace();
  record.strong_share_of_deviator = deviator_product(strong, all) / deviator_product(all, all);
  record.strong_stress_ratio = stress::stress_state(strong).ratio;
  record.weak_stress_ratio = stress::stress_state(weak).ratio;
  const FabricComponent components[] = {fabric_component(bed.frame.contacts, 2, in_strong),
                                        fabric_component(bed.frame.contacts, 2, in_weak)};
  for (std::size_t k = 0; k < std::size(components); ++k) {
    record.network_fabric_amplitude[k] = components[k].amplitude;
    record.network_fabric_angle[k] = radians(components[k].angle);
  }
}

void measure_critical_contacts(const BedFrame& bed, FrameRecord& record) {
  const FrameContacts& contacts = bed.frame.contacts;
  std::vector<bool> touched(bed.statics.free_count, false);
  std::vector<Link> links;
  Index critical = 0;
  for (Index c = 0; c < contacts.count(); ++c) {
    if (contacts.status[c] != ContactStatus::sliding) continue;
    ++critical;
    for_each_free_end(bed, c, [&](Index i) { touched[i] = true; });
    if (contacts.a[c] < bed.statics.free_count && contacts.b[c] < bed.statics.free_count)
      links.push_back({contacts.a[c], contacts.b[c], contacts.shift[c]});
  }
  const Clusters clusters = find_clusters(touched, links, bed.frame.x, period_of(bed.statics));
  std::vector<Index> size(clusters.size.size(), 0);
  for (Index c = 0; c < contacts.count(); ++c)
    if (contacts.status[c] == ContactStatus::sliding) ++size[clusters.label[contacts.a[c]]];
  double squares = 0.0;
  for (const Index each : size) squares += static_cast<double>(each) * each;
  record.critical_share = contacts.count() > 0 ? static_cast<double>(critical) / contacts.count() : not_known;
  record.critical_clusters = static_cast<Index>(size.size());
  record.critical_mean = size.empty() ? not_known : critical / static_cast<double>(size.size());
  record.critical_weighted_mean = size.empty() ? not_known : squares / critical;
  record.critical_largest = size.empty() ? 0 : *std::max_element(size.begin(), size.end());
  record.critical_correlation_length = correlation_length(clusters, bed.frame.y);
}

namespace {

/// Mean of unit vectors at twice the angles of the normals.
struct FabricSum {
  std::complex<double> sum = 0.0;
  Index count = 0;

  void add(std::complex<double> doubled) {
    sum += doubled;
    ++count;
  }
  /// Returns 2 <cos 2 (direction - d)>, where `direction` is the unit vector at twice d.
  double along(std::complex<double> direction) const {
    return count > 0 ? 2.0 * (sum * std::conj(direction)).real() / count : not_known;
  }
};

std::size_t bin_of(double value, std::span<const double> edges) {
  const auto inner = edges.subspan(1, edges.size() - 2);
  return static_cast<std::size_t>(std::ranges::upper_bound(inner, value) - inner.begin());
}

}  // namespace

void measure_weak_contacts(const BedFrame& bed, std::span<const double> edges, FrameRecord& record) {
  const FrameContacts& contacts = bed.frame.contacts;
  FabricSum strong, coherent, incoherent;
  std::vector<FabricSum> by_friction(edges.size() - 1);
  for (Index c = 0; c < contacts.count(); ++c) {
    const std::complex<double> normal = {contacts.nx[c], contacts.ny[c]};
    if (contacts.fn[c] > record.mean_normal_force) {
      strong.add(normal * normal);
      continue;
    }
    const double mobilised = mobilisation_of(bed, c);
    (mobilised >= coherent_mobilisation ? coherent : incoherent).add(normal * normal);
    by_friction[bin_of(mobilised, edges)].add(normal * normal);
  }
  const std::complex<double> chains = strong.sum / std::abs(strong.sum);
  if (contacts.count() > 0) record.coherent_share = static_cast<double>(coherent.count) / contacts.count();
  record.coherent_fabric = coherent.along(chains);
  record.incoherent_fabric = incoherent.along(chains);
  for (const FabricSum& bin : by_friction) record.weak_fabric_by_friction.push_back(bin.along(chains));
}

namespace {

/// Identification of a contact that is the same in every frame.
struct ContactKey {
  Index a = 0, b = 0;
  Index image = 0;  ///< number of additional periods at which b touches a, compared with the unwrapped bed
  Index place = 0;  ///< index in its frame

  auto bodies() const { return std::array<Index, 3>{a, b, image}; }
};

std::vector<ContactKey> keys_of(const Frame& frame) {
  const FrameContacts& contacts = frame.contacts;
  std::vector<ContactKey> keys;
  keys.reserve(contacts.a.size());
  for (Index c = 0; c < contacts.count(); ++c) {
    const Index a = contacts.a[c], b = contacts.b[c];
    const bool grains = b < frame.grain_count();  // otherwise a plane, which has one image
    keys.push_back({a, b, grains ? contacts.shift[c] + frame.image[a] - frame.image[b] : 0, c});
  }
  std::ranges::sort(keys, {}, &ContactKey::bodies);
  return keys;
}

/// Returns the indices of the contacts in the first list that are not in the second.
std::vector<Index> places_of_rest(const std::vector<ContactKey>& keys,
                                  const std::vector<ContactKey>& without) {
  std::vector<ContactKey> rest;
  std::ranges::set_difference(keys, without, std::back_inserter(rest), {}, &ContactKey::bodies,
                              &ContactKey::bodies);
  std::vector<Index> places;
  for (const ContactKey& key : rest) places.push_back(key.place);
  std::ranges::sort(places);
  return places;
}

}  // namespace

ContactChanges contact_changes(const Frame& before, const Frame& after) {
  if (before.grain_count() != after.grain_count())
    throw Error(ExitCode::internal, "cannot compare the contacts of frames with different grains");
  const std::vector<ContactKey> earlier = keys_of(before), later = keys_of(after);
  return {places_of_rest(later, earlier), places_of_rest(earlier, later)};
}

}  // namespace talus::analysis
