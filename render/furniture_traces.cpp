#include "render/furniture_traces.h"

#include <cmath>

#include "render/furniture_shapes.h"

namespace talus::render {
namespace {

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

}  // namespace

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

}  // namespace talus::render
