#include "view/rings.h"

#include <cmath>

#include "core/trigonometry.h"
#include "pictures/bed_view.h"

namespace talus {

void add_circle(FrameView& view, Vec2 centre, double radius, double half_width, const Colour& colour,
                const RunStatics& statics, int circle_lines) {
  const auto corner = [&](int k) {
    const double angle = 2.0 * pi * k / circle_lines;
    return Vec2{centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
  };
  for (int k = 0; k < circle_lines; ++k) {
    const Vec2 from = corner(k), to = corner(k + 1);
    add_line(view,
             {static_cast<float>(from.x), static_cast<float>(from.y), static_cast<float>(to.x),
              static_cast<float>(to.y), static_cast<float>(half_width), colour},
             statics);
  }
}

}  // namespace talus
