#include "view/inspection.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "analysis/free_grains.h"
#include "stress/overload.h"

namespace talus::view {
namespace {

/// Returns the name of a plane, given by the direction in which the grain sees it.
std::string plane_name(double nx) {
  if (nx < -0.5) return "left wall";
  return nx > 0.5 ? "right wall" : "floor";
}

/// Returns the contacts seen from the grain. If the grain is the second body of its contact, the normal and
/// the force are reversed, so that their components along normal and tangent stay.
std::vector<GrainContact> contacts_of(const BedFrame& bed, Index grain) {
  const FrameContacts& all = bed.frame.contacts;
  std::vector<GrainContact> contacts;
  for (Index c = 0; c < all.count(); ++c) {
    if (all.a[c] != grain && all.b[c] != grain) continue;
    const bool first = all.a[c] == grain;
    const double sign = first ? 1.0 : -1.0;
    GrainContact contact;
    contact.key = key_of(all, c);
    contact.other = first ? all.b[c] : all.a[c];
    contact.nx = sign * all.nx[c];
    contact.ny = sign * all.ny[c];
    contact.fn = all.fn[c];
    contact.ft = all.ft[c];
    contact.status = all.status[c];
    contact.other_name = body_name(bed, contact.other, contact.nx);
    contacts.push_back(contact);
  }
  return contacts;
}

/// Returns l_c as coarse_graining computes it.
double length_of(const analysis::NeighbourhoodCurve& curve, const analysis::CoarseGrainingRule& rule) {
  for (std::size_t k = 0; k < curve.l.size() && curve.l[k] <= rule.cut; ++k) {
    const bool below = k + 1 < curve.l.size() && curve.l[k + 1] <= rule.l_min;
    if (!below && curve.gamma[k] <= rule.threshold) return std::max(curve.l[k], rule.l_min);
  }
  return rule.cut;
}

double gamma_at(const analysis::NeighbourhoodCurve& curve, double l) {
  const auto after = std::ranges::upper_bound(curve.l, l);
  return after == curve.l.begin() ? not_known
                                  : curve.gamma[static_cast<std::size_t>(after - curve.l.begin()) - 1];
}

}  // namespace

std::string body_name(const BedFrame& bed, Index body, double nx) {
  if (body >= bed.frame.grain_count()) return plane_name(nx);
  return fmt::format("{} {}", body < bed.statics.free_count ? "grain" : "floor grain", body);
}

Inspection inspect(const BedFrame& bed, const analysis::Clusters& clusters,
                   const analysis::CoarseGrainingRule& rule, double neighbourhood, Index grain) {
  const auto i = static_cast<std::size_t>(grain);
  Inspection inspection;
  inspection.grain = grain;
  inspection.free = grain < bed.statics.free_count;
  inspection.radius = bed.statics.radius[i];
  inspection.mass = bed.statics.mass[i];
  inspection.x = bed.frame.x[i];
  inspection.y = bed.frame.y[i];
  inspection.vx = bed.frame.vx[i];
  inspection.vy = bed.frame.vy[i];
  inspection.omega = bed.frame.omega[i];
  inspection.contacts = contacts_of(bed, grain);
  inspection.internal_moment = bed.frame.internal_moment[i];
  inspection.state = stress::stress_state(inspection.internal_moment);
  inspection.gamma = bed.frame.gamma[i];
  inspection.neighbourhood_gamma = not_known;
  if (!inspection.free) return inspection;
  inspection.overloaded = stress::is_overloaded(inspection.gamma, rule.threshold);
  inspection.cluster = clusters.label[i];
  if (inspection.cluster >= 0)
    inspection.cluster_size = clusters.size[static_cast<std::size_t>(inspection.cluster)];
  const double widest = std::max(rule.cut, neighbourhood);
  inspection.curve = analysis::neighbourhood_curve(bed, grain, widest);
  if (inspection.overloaded) inspection.coarse_graining_length = length_of(inspection.curve, rule);
  inspection.neighbourhood_gamma = gamma_at(inspection.curve, neighbourhood);
  return inspection;
}

double mobilised(double fn, double ft, double friction) {
  return fn > 0.0 && friction > 0.0 ? std::abs(ft) / (friction * fn) : not_known;
}

ContactInspection inspect_contact(const BedFrame& bed, const ContactKey& key) {
  ContactInspection inspection;
  inspection.key = key;
  inspection.friction = bed.frame.friction.grains;
  inspection.mobilisation = not_known;
  const FrameContacts& contacts = bed.frame.contacts;
  if (const auto found = contact_of_key(contacts, key)) {
    const auto c = static_cast<std::size_t>(*found);
    inspection.carries = true;
    inspection.fn = contacts.fn[c];
    inspection.ft = contacts.ft[c];
    inspection.nx = contacts.nx[c];
    inspection.ny = contacts.ny[c];
    inspection.px = contacts.px[c];
    inspection.py = contacts.py[c];
    inspection.status = contacts.status[c];
    inspection.friction = friction_of_contact(bed.frame, *found);
    inspection.mobilisation = mobilised(inspection.fn, inspection.ft, inspection.friction);
  }
  inspection.a_name = body_name(bed, key.a, -inspection.nx);
  inspection.b_name = body_name(bed, key.b, inspection.nx);
  return inspection;
}

std::optional<Index> find_grain(const BedFrame& bed, double x, double y) {
  const double period = analysis::period_of(bed.statics);
  std::optional<Index> nearest;
  double least = bed.statics.mean_diameter;  // distance from the edge of a disc; negative inside it
  for (Index i = 0; i < bed.frame.grain_count(); ++i) {
    double dx = bed.frame.x[i] - x;
    if (period > 0.0) dx -= period * std::round(dx / period);
    const double distance = std::hypot(dx, bed.frame.y[i] - y) - bed.statics.radius[i];
    if (distance > least) continue;
    least = distance;
    nearest = i;
  }
  return nearest;
}

}  // namespace talus::view
