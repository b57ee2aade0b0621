#include "analysis/contacts/weak_contacts.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "analysis/contacts/contact_network.h"

namespace talus::analysis {
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

WeakContacts weak_contacts(const BedFrame& bed, double mean_normal_force, std::span<const double> edges) {
  const FrameContacts& contacts = bed.frame.contacts;
  FabricSum strong, coherent, incoherent;
  std::vector<FabricSum> by_friction(edges.size() - 1);
  for (Index c = 0; c < contacts.count(); ++c) {
    const std::complex<double> normal = {contacts.nx[c], contacts.ny[c]};
    if (contacts.fn[c] > mean_normal_force) {
      strong.add(normal * normal);
      continue;
    }
    const double mobilised = mobilisation_of(bed, c);
    (mobilised >= coherent_mobilisation ? coherent : incoherent).add(normal * normal);
    by_friction[bin_of(mobilised, edges)].add(normal * normal);
  }
  const std::complex<double> chains = strong.sum / std::abs(strong.sum);
  WeakContacts weak;
  if (contacts.count() > 0) weak.coherent_share = static_cast<double>(coherent.count) / contacts.count();
  weak.coherent_fabric = coherent.along(chains);
  weak.incoherent_fabric = incoherent.along(chains);
  for (const FabricSum& bin : by_friction) weak.fabric_by_friction.push_back(bin.along(chains));
  return weak;
}

void measure_weak_contacts(const BedFrame& bed, std::span<const double> edges, FrameRecord& record) {
  const WeakContacts weak = weak_contacts(bed, record.mean_normal_force, edges);
  record.coherent_share = weak.coherent_share;
  record.coherent_fabric = weak.coherent_fabric;
  record.incoherent_fabric = weak.incoherent_fabric;
  record.weak_fabric_by_friction = weak.fabric_by_friction;
}

}  // namespace talus::analysis
