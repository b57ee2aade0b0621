#include "view/selection.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "analysis/free_grains.h"
#include "stress/stress.h"

namespace talus::view {
namespace {

/// Returns whether a ray from the point along +x crosses the line an odd number of times.
bool is_within(std::span<const Vec2> outline, double x, double y) {
  bool within = false;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2 from = outline[k], to = outline[(k + 1) % outline.size()];
    if ((from.y > y) == (to.y > y)) continue;
    if (x < from.x + (to.x - from.x) * (y - from.y) / (to.y - from.y)) within = !within;
  }
  return within;
}

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
    const std::string other = body_name(bed, first ? all.b[c] : all.a[c], first ? all.nx[c] : -all.nx[c]);
    contacts.push_back({key_of(all, c), other, all.fn[c], all.ft[c], all.status[c]});
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

std::vector<Index> toggled(std::vector<Index> grains, Index grain) {
  const auto place = std::ranges::lower_bound(grains, grain);
  if (place != grains.end() && *place == grain)
    grains.erase(place);
  else
    grains.insert(place, grain);
  return grains;
}

std::vector<Index> grains_within(const BedFrame& bed, std::span<const Vec2> outline) {
  std::vector<Index> grains;
  if (outline.size() < 3) return grains;
  const double period = analysis::period_of(bed.statics);
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double x = bed.frame.x[k], y = bed.frame.y[k];
    const bool image =
        period > 0.0 && (is_within(outline, x - period, y) || is_within(outline, x + period, y));
    if (image || is_within(outline, x, y)) grains.push_back(i);
  }
  return grains;
}

std::optional<ContactKey> find_contact(const BedFrame& bed, double x, double y, double reach) {
  const FrameContacts& contacts = bed.frame.contacts;
  const double period = analysis::period_of(bed.statics);
  std::optional<Index> nearest;
  double least = reach;
  for (Index c = 0; c < contacts.count(); ++c) {
    const auto k = static_cast<std::size_t>(c);
    double dx = contacts.px[k] - x;
    if (period > 0.0) dx -= period * std::round(dx / period);
    const double distance = std::hypot(dx, contacts.py[k] - y);
    if (distance > least) continue;
    least = distance;
    nearest = c;
  }
  return nearest ? std::optional(key_of(contacts, *nearest)) : std::nullopt;
}

ContactKey key_of(const FrameContacts& contacts, Index c) {
  const auto k = static_cast<std::size_t>(c);
  return {contacts.a[k], contacts.b[k], contacts.shift[k]};
}

std::optional<Index> contact_of_key(const FrameContacts& contacts, const ContactKey& key) {
  const auto first = std::ranges::lower_bound(contacts.a, key.a) - contacts.a.begin();  // sorted by key
  for (auto c = static_cast<Index>(first); c < contacts.count() && contacts.a[c] == key.a; ++c)
    if (key_of(contacts, c) == key) return c;
  return std::nullopt;
}

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
  inspection.contacts = contacts_of(bed, grain);
  inspection.state = stress::stress_state(bed.frame.internal_moment[i]);
  inspection.gamma = bed.frame.gamma[i];
  inspection.neighbourhood_gamma = not_known;
  if (!inspection.free) return inspection;
  inspection.overloaded = stress::is_overloaded(inspection.gamma, rule.threshold);
  inspection.cluster = clusters.label[i];
  if (inspection.cluster >= 0)
    inspection.cluster_size = clusters.size[static_cast<std::size_t>(inspection.cluster)];
  inspection.curve = analysis::neighbourhood_curve(bed, grain, std::max(rule.cut, neighbourhood));
  if (inspection.overloaded) inspection.coarse_graining_length = length_of(inspection.curve, rule);
  inspection.neighbourhood_gamma = gamma_at(inspection.curve, neighbourhood);
  return inspection;
}

double mobilised(double fn, double ft, double friction) {
  return fn > 0.0 && friction > 0.0 ? std::abs(ft) / (friction * fn) : not_known;
}

ContactInspection inspect_contact(const BedFrame& bed, const ContactKey& key) {
  ContactInspection inspection{instant_of(bed.frame, key), key};
  const FrameContacts& contacts = bed.frame.contacts;
  if (const auto found = contact_of_key(contacts, key)) {
    const auto c = static_cast<std::size_t>(*found);
    inspection.carries = true;
    inspection.nx = contacts.nx[c];
    inspection.ny = contacts.ny[c];
    inspection.px = contacts.px[c];
    inspection.py = contacts.py[c];
    inspection.status = contacts.status[c];
  } else {
    inspection.friction = bed.frame.friction.grains;
  }
  inspection.mobilisation = mobilised(inspection.fn, inspection.ft, inspection.friction);
  inspection.a_name = body_name(bed, key.a, -inspection.nx);
  inspection.b_name = body_name(bed, key.b, inspection.nx);
  return inspection;
}

HistoryInstant instant_of(const Frame& frame, const ContactKey& contact) {
  HistoryInstant instant{frame.time, frame.tilt};
  if (const auto found = contact_of_key(frame.contacts, contact)) {
    const auto c = static_cast<std::size_t>(*found);
    instant.fn = frame.contacts.fn[c];
    instant.ft = frame.contacts.ft[c];
    instant.friction = friction_of_contact(frame, *found);
  }
  return instant;
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
