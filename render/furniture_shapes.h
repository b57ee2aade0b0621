#pragma once
/// The shapes that furniture is made of. Boxes and points are in px from the left and from the top.

#include "render/furniture.h"

namespace talus::render {

/// A plain rectangle whose colour runs from left to right.
inline void add_gradient(Furniture& furniture, const Box& box, const Colour& left, const Colour& right) {
  const auto corner = [](double x, double y, const Colour& colour) {
    return FurnitureVertex{static_cast<float>(x), static_cast<float>(y), -1.0f, 0.0f, colour};
  };
  const FurnitureVertex a = corner(box.x, box.y, left), b = corner(box.right(), box.y, right);
  const FurnitureVertex c = corner(box.x, box.bottom(), left), d = corner(box.right(), box.bottom(), right);
  furniture.triangles.insert(furniture.triangles.end(), {a, b, c, c, b, d});
}

inline void add_area(Furniture& furniture, const Box& box, const Colour& colour) {
  add_gradient(furniture, box, colour, colour);
}

/// A frame of lines around a box, outside of it.
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
