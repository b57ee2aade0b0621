#pragma once
/// The shapes that furniture consists of. Boxes and points are in px from the left and from the top.

#include "render/furniture.h"

namespace talus::render {

inline void add_area(Furniture& furniture, const Box& box, const Colour& colour) {
  furniture.areas.push_back({box, {colour}});
}

/// Adds a frame of lines around a box, outside it.
inline void add_frame(Furniture& furniture, const Box& box, double line) {
  add_area(furniture, {box.x - line, box.y - line, box.width + 2.0 * line, line}, black);
  add_area(furniture, {box.x - line, box.bottom(), box.width + 2.0 * line, line}, black);
  add_area(furniture, {box.x - line, box.y, line, box.height}, black);
  add_area(furniture, {box.right(), box.y, line, box.height}, black);
}

inline void add_line(Furniture& furniture, const Point& from, const Point& to, double half_width,
                     const Colour& colour) {
  furniture.lines.push_back({static_cast<float>(from.x), static_cast<float>(-from.y),
                             static_cast<float>(to.x), static_cast<float>(-to.y),
                             static_cast<float>(half_width), colour});
}

}  // namespace talus::render
