#include "analysis/overload/links.h"

#include <algorithm>

#include "analysis/cells.h"
#include "analysis/free_grains.h"

namespace talus::analysis {

std::vector<Link> force_links(const BedFrame& bed) {
  const FrameContacts& contacts = bed.frame.contacts;
  std::vector<Link> links;
  for (Index c = 0; c < contacts.count(); ++c)
    if (contacts.a[c] < bed.statics.free_count && contacts.b[c] < bed.statics.free_count)
      links.push_back({contacts.a[c], contacts.b[c], contacts.shift[c]});
  return links;
}

std::vector<Link> neighbour_links(const BedFrame& bed, double reach) {
  std::vector<Link> links;
  if (bed.statics.free_count == 0) return links;
  const double period = period_of(bed.statics);
  const std::vector<double> x = free_grain_values(bed.frame.x, bed.statics);
  const std::vector<double> y = free_grain_values(bed.frame.y, bed.statics);
  const double largest = *std::max_element(bed.statics.radius.begin(), bed.statics.radius.end());
  const Cells cells = sort_into_cells(x, y, 2.0 * largest * reach, period);
  for (Index a = 0; a < bed.statics.free_count; ++a) {
    const auto first = static_cast<std::ptrdiff_t>(links.size());
    const auto link_to = [&](Index b) {
      if (b <= a) return;
      const Index shift = nearest_image(x[b] - x[a], period);
      const double dx = x[b] - x[a] + shift * period;
      const double dy = y[b] - y[a];
      const double limit = reach * (bed.statics.radius[a] + bed.statics.radius[b]);
      if (dx * dx + dy * dy < limit * limit) links.push_back({a, b, static_cast<std::int8_t>(shift)});
    };
    for (Index ring = 0; ring <= 1; ++ring)
      visit_ring(cells, column_of(cells, x[a]), row_of(cells, y[a]), ring, link_to);
    std::sort(links.begin() + first, links.end(),
              [](const Link& one, const Link& other) { return one.b < other.b; });
  }
  return links;
}

}  // namespace talus::analysis
