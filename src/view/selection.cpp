#include "view/selection.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "analysis/free_grains.h"

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

std::optional<Index> find_contact(const BedFrame& bed, double x, double y, double reach) {
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
  return nearest;
}

ContactKey key_of(const FrameContacts& contacts, Index c) {
  const auto k = static_cast<std::size_t>(c);
  return {contacts.a[k], contacts.b[k], contacts.shift[k]};
}

std::optional<Index> contact_of_key(const FrameContacts& contacts, const ContactKey& key) {
  Index low = 0, high = contacts.count();  // contacts are sorted by key
  const auto before = [&](Index c) {
    const ContactKey candidate = key_of(contacts, c);
    return std::tie(candidate.a, candidate.b, candidate.shift) < std::tie(key.a, key.b, key.shift);
  };
  while (low < high) {
    const Index middle = low + (high - low) / 2;
    (before(middle) ? low : high) = before(middle) ? middle + 1 : middle;
  }
  if (low == contacts.count() || !(key_of(contacts, low) == key)) return std::nullopt;
  return low;
}

}  // namespace talus::view
