#include "contact/detection.h"

#include <cmath>

namespace talus {
namespace {

struct Geometry {
  Vec2 normal;
  double gap = 0.0;
};

/// False where the gap is not below the margin; most candidates end here, before the square root.
bool grain_pair(const Grains& grains, Index a, Index b, double offset, double margin, Geometry& geometry) {
  const double dx = grains.x[b] + offset - grains.x[a];
  const double dy = grains.y[b] - grains.y[a];
  const double contact_distance = grains.radius[a] + grains.radius[b];
  const double limit = contact_distance + margin;
  const double square = dx * dx + dy * dy;
  if (!(square < limit * limit)) return false;
  const double distance = std::sqrt(square);
  geometry.gap = distance - contact_distance;
  geometry.normal = distance > 0.0 ? Vec2{dx / distance, dy / distance} : Vec2{0.0, 1.0};
  return true;
}

bool plane_pair(const Grains& grains, Index a, const Plane& plane, double margin, Geometry& geometry) {
  const double distance = plane.normal.x * grains.x[a] + plane.normal.y * grains.y[a] - plane.offset;
  geometry.gap = distance - grains.radius[a];
  geometry.normal = {-plane.normal.x, -plane.normal.y};  // from the grain to the plane
  return geometry.gap < margin;
}

}  // namespace

void detect_contacts(NeighbourList& list, const Grains& grains, const Boundary& boundary, double margin,
                     Contacts& contacts) {
  update_neighbour_list(list, grains, boundary, margin);
  const std::size_t candidates = list.a.size();
  contacts.resize(candidates);
  std::size_t count = 0;
  for (std::size_t k = 0; k < candidates; ++k) {
    const Index a = list.a[k];
    const Index b = list.b[k];
    Geometry geometry;
    const bool near =
        b < grains.count()
            ? grain_pair(grains, a, b, list.shift[k] * boundary.length, margin, geometry)
            : plane_pair(grains, a, boundary.planes[static_cast<std::size_t>(b - grains.count())], margin,
                         geometry);
    if (!near) continue;
    contacts.a[count] = a;
    contacts.b[count] = b;
    contacts.shift[count] = list.shift[k];
    contacts.nx[count] = geometry.normal.x;
    contacts.ny[count] = geometry.normal.y;
    contacts.gap[count] = geometry.gap;
    contacts.fn[count] = 0.0;
    contacts.ft[count] = 0.0;
    ++count;
  }
  contacts.resize(count);
}

}  // namespace talus
