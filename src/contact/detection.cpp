#include "contact/detection.h"

#include <cmath>

namespace talus {
namespace {

/// The normal of a contact, from a to b, and its gap; the tangent is the normal turned by +90 degrees (T3).
struct LocalFrame {
  Vec2 normal;
  double gap = 0.0;
  bool near = false;  ///< the gap is below the margin
};

LocalFrame local_frame_of_grains(double dx, double dy, double contact_distance, double margin) {
  const double limit = contact_distance + margin;
  const double square = dx * dx + dy * dy;
  const double distance = std::sqrt(square);
  const Vec2 normal = distance > 0.0 ? Vec2{dx / distance, dy / distance} : Vec2{0.0, 1.0};
  return {normal, distance - contact_distance, square < limit * limit};
}

LocalFrame local_frame_with_plane(const Grains& grains, Index a, const Plane& plane, double margin) {
  const double distance = plane.normal.x * grains.x[a] + plane.normal.y * grains.y[a] - plane.offset;
  const double gap = distance - grains.radius[a];
  return {{-plane.normal.x, -plane.normal.y}, gap, gap < margin};  // from the grain to the plane
}

/// Writes the candidates whose gap is below the margin, and returns their number. Each candidate is written
/// and then kept or not, without a branch: most are near, and the branch would be unpredictable.
std::size_t write_near(const NeighbourList& list, const Grains& grains, const Boundary& boundary,
                       double margin, Contacts& contacts) {
  const std::size_t candidates = list.a.size();
  std::size_t count = 0;
  for (std::size_t k = 0; k < candidates; ++k) {
    const Index a = list.a[k];
    const Index b = list.b[k];
    const std::int8_t shift = list.shift[k];
    const LocalFrame frame =
        b < grains.count()
            ? local_frame_of_grains(grains.x[b] + shift * boundary.length - grains.x[a],
                                    grains.y[b] - grains.y[a], list.contact_distance[k], margin)
            : local_frame_with_plane(grains, a, boundary.planes[static_cast<std::size_t>(b - grains.count())],
                                     margin);
    contacts.a[count] = a;
    contacts.b[count] = b;
    contacts.nx[count] = frame.normal.x;
    contacts.ny[count] = frame.normal.y;
    contacts.gap[count] = frame.gap;
    contacts.shift[count] = shift;
    count += frame.near ? 1 : 0;
  }
  return count;
}

}  // namespace

void detect_contacts(NeighbourList& list, const Grains& grains, const Boundary& boundary, double margin,
                     Contacts& contacts) {
  update_neighbour_list(list, grains, boundary, margin);
  contacts.resize(list.a.size());
  contacts.resize(write_near(list, grains, boundary, margin, contacts));
}

}  // namespace talus
