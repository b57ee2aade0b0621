#include "render/furniture.h"

#include <algorithm>
#include <cmath>

namespace talus::render {
namespace {

// The shapes that furniture consists of. Boxes and points are in px from the left and from the top.

void add_area(Furniture& furniture, const Box& box, const Colour& colour) {
  furniture.areas.push_back({box, {colour}});
}

/// Adds a frame of lines around a box, outside it.
void add_frame(Furniture& furniture, const Box& box, double line) {
  add_area(furniture, {box.x - line, box.y - line, box.width + 2.0 * line, line}, black);
  add_area(furniture, {box.x - line, box.bottom(), box.width + 2.0 * line, line}, black);
  add_area(furniture, {box.x - line, box.y, line, box.height}, black);
  add_area(furniture, {box.right(), box.y, line, box.height}, black);
}

void add_line(Furniture& furniture, const Point& from, const Point& to, double half_width,
              const Colour& colour) {
  furniture.lines.push_back({static_cast<float>(from.x), static_cast<float>(-from.y),
                             static_cast<float>(to.x), static_cast<float>(-to.y),
                             static_cast<float>(half_width), colour});
}

// The curves below a map.

constexpr Colour curve_colour{0, 0, 0, 255};
constexpr Colour mark_colour{130, 130, 130, 255};

void add_curve(Furniture& furniture, const std::vector<Point>& curve, double half_width) {
  const auto drawn = [&](std::size_t k) { return !std::isnan(curve[k].y); };
  for (std::size_t k = 0; k < curve.size(); ++k) {
    if (!drawn(k)) continue;
    if (k + 1 < curve.size() && drawn(k + 1))
      add_line(furniture, curve[k], curve[k + 1], half_width, curve_colour);
    else if (k == 0 || !drawn(k - 1))  // an isolated point between gaps
      add_line(furniture, curve[k], curve[k], half_width, curve_colour);
  }
}

void add_dashes(Furniture& furniture, double x, const Box& box, double dash, double line) {
  for (double y = box.y; y < box.bottom(); y += 2.0 * dash)
    add_area(furniture, {std::round(x - 0.5 * line), y, line, std::min(dash, box.bottom() - y)}, black);
}

/// Adds a frame with ticks, the curve, and the mark of the frame shown. `em` is the font size and `line` the
/// width of thin lines, px.
void add_trace(Furniture& furniture, const PlacedTrace& trace, double em, double line) {
  add_frame(furniture, trace.box, line);
  const double length = std::round(0.3 * em);
  for (double x : trace.x_ticks)
    add_area(furniture, {std::round(x - 0.5 * line), trace.box.bottom() - length, line, length}, black);
  for (double y : trace.y_ticks)
    add_area(furniture, {trace.box.x, std::round(y - 0.5 * line), length, line}, black);
  if (!std::isnan(trace.event)) add_dashes(furniture, trace.event, trace.box, std::round(0.4 * em), line);
  const bool in_frame = trace.mark.x >= trace.box.x && trace.mark.x <= trace.box.right();
  if (in_frame)
    add_area(furniture, {std::round(trace.mark.x - 0.5 * line), trace.box.y, line, trace.box.height},
             mark_colour);
  add_curve(furniture, trace.curve, 0.6 * line);
  if (in_frame && !std::isnan(trace.mark.y))
    furniture.discs.push_back({static_cast<float>(trace.mark.x), static_cast<float>(-trace.mark.y),
                               static_cast<float>(0.3 * em), black, black, 0.0f});
}

void add_bar(Furniture& furniture, const PlacedBar& bar, double em, double line) {
  add_frame(furniture, bar.box, line);
  furniture.areas.push_back({bar.box, bar.colours});
  const double length = std::round(0.3 * em);
  for (double tick : bar.ticks)
    add_area(furniture, {std::round(tick - 0.5 * line), bar.box.bottom(), line, length}, black);
}

void add_swatch(Furniture& furniture, const PlacedSwatch& placed) {
  const Box& box = placed.box;
  const auto middle = static_cast<float>(-box.y - 0.5 * box.height);
  const Swatch& swatch = placed.swatch;
  if (swatch.kind == Swatch::Kind::disc) {
    furniture.discs.push_back({static_cast<float>(box.x + 0.5 * box.width), middle,
                               static_cast<float>(0.5 * box.width), swatch.fill, swatch.rim, 0.0f});
    return;
  }
  const double half = 0.5 * swatch.width * box.height;
  furniture.lines.push_back({static_cast<float>(box.x + half), middle, static_cast<float>(box.right() - half),
                             middle, static_cast<float>(half), swatch.fill});
}

void add_scale_bar(Furniture& furniture, const Box& box, double line) {
  if (box.width == 0.0) return;
  const double x = std::round(box.x), y = std::round(box.y);
  add_area(furniture, {x, y + std::round(0.5 * (box.height - line)), box.width, line}, black);
  add_area(furniture, {x, y, line, box.height}, black);
  add_area(furniture, {x + box.width - line, y, line, box.height}, black);
}

/// Adds an arrow that is as long as its box and centred in it, in the direction (x, y), y downwards.
void add_arrow(Furniture& furniture, const Box& box, double along_x, double along_y, double line) {
  if (box.width == 0.0) return;
  const double x = box.x + 0.5 * box.width, y = box.y + 0.5 * box.height;
  const double reach = 0.5 * box.width - line;
  const double tip_x = x + reach * along_x, tip_y = y + reach * along_y;
  const double head = 0.5 * reach;
  const double half_width = 0.75 * line;
  add_line(furniture, {x - reach * along_x, y - reach * along_y}, {tip_x, tip_y}, half_width, black);
  for (double side : {-0.5, 0.5})
    add_line(furniture,
             {tip_x - head * (along_x - side * along_y), tip_y - head * (along_y + side * along_x)},
             {tip_x, tip_y}, half_width, black);
}

/// Adds the walls and the floor of a bed that is not turned, just outside it, on whole pixels.
void add_upright_edges(Furniture& furniture, const FrameView& view, const Box& bed, double width) {
  const double left = view.left_wall ? width : 0.0, right = view.right_wall ? width : 0.0;
  if (view.left_wall) add_area(furniture, {bed.x - width, bed.y, width, bed.height}, black);
  if (view.right_wall) add_area(furniture, {bed.right(), bed.y, width, bed.height}, black);
  if (view.floor_line)
    add_area(furniture, {bed.x - left, bed.bottom(), bed.width + left + right, width}, black);
}

/// Adds the walls and the floor of a turned bed.
void add_turned_edges(Furniture& furniture, const FrameView& view, const Window& bed, double width) {
  const double out = 0.5 * width / bed.camera.scale;  // m
  const double left = bed.x_min - (view.left_wall ? out : 0.0),
               right = bed.x_max + (view.right_wall ? out : 0.0);
  const double low = bed.y_min - (view.floor_line ? out : 0.0);
  const auto edge = [&](double x0, double y0, double x1, double y1) {
    add_line(furniture, bed.camera.project(x0, y0), bed.camera.project(x1, y1), 0.5 * width, black);
  };
  if (view.left_wall) edge(left, low, left, bed.y_max);
  if (view.right_wall) edge(right, low, right, bed.y_max);
  if (view.floor_line) edge(left, low, right, low);
}

}  // namespace

Furniture furnish(const FrameView& view, const Layout& layout) {
  Furniture furniture;
  furniture.texts = layout.texts;
  const double line = std::max(1.0, std::round(layout.em / 12.0));  // px; a whole number, for crisp edges
  if (view.turn_max == 0.0)
    add_upright_edges(furniture, view, layout.bed.box, 2.0 * line);
  else
    add_turned_edges(furniture, view, layout.bed, 2.0 * line);
  for (const PlacedBar& bar : layout.bars) add_bar(furniture, bar, layout.em, line);
  add_scale_bar(furniture, layout.scale_bar, line);
  const double fall = view.tilt - view.turn;  // angle from straight down to gravity
  add_arrow(furniture, layout.arrow, std::sin(fall), std::cos(fall), line);
  for (const PlacedTrace& trace : layout.traces) add_trace(furniture, trace, layout.em, line);
  for (const PlacedSwatch& swatch : layout.swatches) add_swatch(furniture, swatch);
  return furniture;
}

}  // namespace talus::render
