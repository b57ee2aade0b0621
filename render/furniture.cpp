#include "render/furniture.h"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

/// A plain rectangle whose shade runs from left to right.
void add_area(Furniture& furniture, const Box& box, double shade_left, double shade_right) {
  const auto corner = [](double x, double y, double shade) {
    return FurnitureVertex{static_cast<float>(x), static_cast<float>(y), -1.0f, 0.0f,
                           static_cast<float>(shade)};
  };
  const FurnitureVertex a = corner(box.x, box.y, shade_left), b = corner(box.right(), box.y, shade_right);
  const FurnitureVertex c = corner(box.x, box.bottom(), shade_left),
                        d = corner(box.right(), box.bottom(), shade_right);
  furniture.triangles.insert(furniture.triangles.end(), {a, b, c, c, b, d});
}

void add_frame(Furniture& furniture, const Box& box, double line) {
  add_area(furniture, {box.x - line, box.y - line, box.width + 2.0 * line, line}, 1.0, 1.0);
  add_area(furniture, {box.x - line, box.bottom(), box.width + 2.0 * line, line}, 1.0, 1.0);
  add_area(furniture, {box.x - line, box.y, line, box.height}, 1.0, 1.0);
  add_area(furniture, {box.right(), box.y, line, box.height}, 1.0, 1.0);
}

void add_text(Furniture& furniture, const PlacedText& text, double em, const Font& font,
              const GlyphAtlas& atlas) {
  const double base_line = std::round(text.box.y + text_ascent * em);
  for (const Glyph& glyph : set_text(font, text.text, em).glyphs) {
    const std::vector<stbtt_packedchar>& glyphs = glyph.subscript ? atlas.subscript : atlas.plain;
    auto x = static_cast<float>(text.box.x + glyph.x);
    auto y = static_cast<float>(base_line + (glyph.subscript ? std::round(subscript_drop * em) : 0.0));
    stbtt_aligned_quad quad;
    stbtt_GetPackedQuad(glyphs.data(), atlas.size, atlas.size, static_cast<int>(glyph.code), &x, &y, &quad,
                        0);
    const FurnitureVertex a{quad.x0, quad.y0, quad.s0, quad.t0, 1.0f},
        b{quad.x1, quad.y0, quad.s1, quad.t0, 1.0f};
    const FurnitureVertex c{quad.x0, quad.y1, quad.s0, quad.t1, 1.0f},
        d{quad.x1, quad.y1, quad.s1, quad.t1, 1.0f};
    furniture.triangles.insert(furniture.triangles.end(), {a, b, c, c, b, d});
  }
}

void add_bar(Furniture& furniture, const Layout& layout, double line) {
  if (layout.bar.width == 0.0) return;
  add_frame(furniture, layout.bar, line);
  add_area(furniture, layout.bar, 0.0, 1.0);
  const double length = std::round(0.3 * layout.em);
  for (double tick : layout.ticks)
    add_area(furniture, {std::round(tick - 0.5 * line), layout.bar.bottom(), line, length}, 1.0, 1.0);
}

void add_scale_bar(Furniture& furniture, const Box& box, double line) {
  const double x = std::round(box.x), y = std::round(box.y);
  add_area(furniture, {x, y + std::round(0.5 * (box.height - line)), box.width, line}, 1.0, 1.0);
  add_area(furniture, {x, y, line, box.height}, 1.0, 1.0);
  add_area(furniture, {x + box.width - line, y, line, box.height}, 1.0, 1.0);
}

/// An arrow of the length of its box, about the box's centre, along gravity (sin tilt, -cos tilt).
void add_arrow(Furniture& furniture, const Box& box, double tilt, double line) {
  const double x = box.x + 0.5 * box.width, y = box.y + 0.5 * box.height;
  const double reach = 0.5 * box.width - line;
  const double along_x = std::sin(tilt), along_y = std::cos(tilt);  // pixels count downwards
  const double tip_x = x + reach * along_x, tip_y = y + reach * along_y;
  const double head = 0.5 * reach;
  const auto segment = [&](double from_x, double from_y) {
    furniture.segments.push_back({static_cast<float>(from_x), static_cast<float>(from_y),
                                  static_cast<float>(tip_x), static_cast<float>(tip_y),
                                  static_cast<float>(0.75 * line), 1.0f});
  };
  segment(x - reach * along_x, y - reach * along_y);
  for (double side : {-0.5, 0.5})
    segment(tip_x - head * (along_x - side * along_y), tip_y - head * (along_y + side * along_x));
}

/// Walls and floor, drawn just outside the bed.
void add_edges(Furniture& furniture, const FrameView& view, const Box& bed, double line) {
  const double width = 2.0 * line;
  if (view.walls) {
    add_area(furniture, {bed.x - width, bed.y, width, bed.height}, 1.0, 1.0);
    add_area(furniture, {bed.right(), bed.y, width, bed.height}, 1.0, 1.0);
  }
  const double beyond = view.walls ? width : 0.0;
  if (view.floor_line)
    add_area(furniture, {bed.x - beyond, bed.bottom(), bed.width + 2.0 * beyond, width}, 1.0, 1.0);
}

}  // namespace

Furniture furnish(const FrameView& view, const Layout& layout, const Font& font, const GlyphAtlas& atlas) {
  Furniture furniture;
  const double line = std::max(1.0, std::round(layout.em / 12.0));  // px, whole: crisp
  add_edges(furniture, view, layout.bed, line);
  add_bar(furniture, layout, line);
  add_scale_bar(furniture, layout.scale_bar, line);
  add_arrow(furniture, layout.arrow, view.tilt, line);
  for (const PlacedText& text : layout.texts) add_text(furniture, text, layout.em, font, atlas);
  for (const PlacedSwatch& swatch : layout.swatches)
    furniture.swatches.push_back({static_cast<float>(swatch.box.x + 0.5 * swatch.box.width),
                                  static_cast<float>(-swatch.box.y - 0.5 * swatch.box.height),
                                  static_cast<float>(0.5 * swatch.box.width),
                                  static_cast<float>(swatch.shade), 0.0f});
  return furniture;
}

}  // namespace talus
