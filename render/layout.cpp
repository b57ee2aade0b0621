#include "render/layout.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <optional>

#include "base/errors.h"
#include "render/layout_groups.h"
#include "render/layout_traces.h"

namespace talus::render {
namespace {

// Lengths in units of the font size.
constexpr double margin = 0.8;
constexpr double gap_between_rows = 0.3;

constexpr double smallest_em = 6.0;  // px; smaller type is illegible
/// Smallest relative font size that is tried before lines are broken.
constexpr double min_unbroken = 0.8;

/// Places groups from left to right, `last` at the right end, in as many rows as they need. Returns the lower
/// edge, px.
double add_rows(Layout& layout, const std::vector<Group>& groups, const Group& last, double y, double side) {
  const double right = layout.width - side;
  const double gap = gap_between_groups * layout.em;
  double x = side, bottom = y;
  const auto begin_row = [&] {
    x = side;
    y = std::ceil(bottom + gap_between_rows * layout.em);
  };
  for (const Group& group : groups) {
    if (group.height == 0.0) continue;
    if (x > side && x + group.width > right) begin_row();
    add_group(layout, group, x, y);
    x += group.width + gap;
    bottom = std::max(bottom, y + group.height);
  }
  if (last.height > 0.0) {
    if (x > side && x + last.width > right) begin_row();
    add_group(layout, last, std::floor(right - last.width), y);
    bottom = std::max(bottom, y + last.height);
  }
  return std::ceil(bottom);
}

/// Returns the height, px. Throws Error(usage) if it exceeds largest_side.
int checked_height(int width, double height) {
  if (height > largest_side)
    throw Error(ExitCode::usage,
                fmt::format("a picture of this bed that is {} px wide would be {} px high; at "
                            "most {} px are possible: use a smaller width",
                            width, std::llround(height), largest_side));
  return static_cast<int>(height);
}

/// Returns the largest a cos(turn) + b sin(turn) for turns from 0 to turn_max.
double largest_extent(double a, double b, double turn_max) {
  const double turn = std::clamp(std::atan2(b, a), 0.0, turn_max);
  return a * std::cos(turn) + b * std::sin(turn);
}

/// Places the bed in a box of that width with its upper left corner at (x, y). The box is as high as the
/// bed's own turn needs or, by default, as high as any turn up to turn_max needs.
Window place_bed(const FrameView& view, double x, double y, double width, bool own_turn = false) {
  const double length = view.x_max - view.x_min, depth = view.y_max - view.y_min;
  const double seen_length = largest_extent(length, depth, view.turn_max);
  const double seen_depth = view.turn_max == 0.0 ? depth
                            : own_turn           ? depth * std::cos(view.turn) + length * std::sin(view.turn)
                                                 : largest_extent(depth, length, view.turn_max);
  Window window;
  window.x_min = view.x_min;
  window.x_max = view.x_max;
  window.y_min = view.y_min;
  window.y_max = view.y_max;
  Camera& camera = window.camera;
  camera.scale = width / seen_length;
  window.box = {x, y, width, std::ceil(seen_depth * camera.scale)};
  if (view.turn_max == 0.0) {  // anchored at the lower left corner, which keeps coordinates exact
    camera.origin_x = x - view.x_min * camera.scale;
    camera.origin_y = window.box.bottom() + view.y_min * camera.scale;
    return window;
  }
  camera.cosine = std::cos(view.turn);
  camera.sine = std::sin(view.turn);
  const Point centre = camera.project(0.5 * (view.x_min + view.x_max), 0.5 * (view.y_min + view.y_max));
  camera.origin_x = x + 0.5 * window.box.width - centre.x;
  camera.origin_y = y + 0.5 * window.box.height - centre.y;
  return window;
}

/// Lays out a picture of the bed alone.
Layout lay_out_bed(const FrameView& view, int width) {
  Layout layout;
  layout.width = width;
  layout.bed = place_bed(view, 0.0, 0.0, width);
  layout.height = checked_height(width, layout.bed.box.height);
  return layout;
}

std::vector<Group> legend_groups(const std::vector<Legend>& legends, double room, double em,
                                 const Font& font) {
  std::vector<Group> groups;
  for (const Legend& legend : legends) {
    for (const Bar& bar : legend.bars) groups.push_back(bar_group(bar, room, em, font));
    for (const Swatch& swatch : legend.swatches) groups.push_back(swatch_group(swatch, room, em, font));
  }
  return groups;
}

/// Returns the distance in px by which a turned bed can move up next to the texts above it, into the room
/// that its slope leaves.
double room_above(const Layout& layout, const FrameView& view, const Window& bed) {
  const Point foot = bed.camera.project(view.x_min, view.y_min),
              top = bed.camera.project(view.x_min, view.y_max),
              end = bed.camera.project(view.x_max, view.y_max);
  double room = bed.box.y - std::ceil(0.5 * layout.em);
  const auto keep_off = [&](const Box& box) {
    double edge = top.y;  // the upper edge of the bed at its highest point below the box
    if (box.x > top.x)
      edge = std::lerp(top.y, end.y, (box.x - top.x) / (end.x - top.x));
    else if (box.right() < top.x)
      edge = std::lerp(foot.y, top.y, std::max(0.0, (box.right() - foot.x) / (top.x - foot.x)));
    room = std::min(room, edge - box.bottom() - 0.4 * layout.em);
  };
  for (const PlacedText& text : layout.texts) keep_off(text.box);
  if (layout.arrow.width > 0.0) keep_off(layout.arrow);
  return std::max(0.0, std::floor(room));
}

/// Returns the layout in one font size, with or without broken lines, if everything fits the width.
std::optional<Layout> lay_out_with(const FrameView& view, int width, double em, bool broken, const Font& font,
                                   const LayoutLimits& limits) {
  Layout layout;
  layout.width = width;
  layout.em = em;
  const double side = std::ceil(margin * em);
  const double available = width - 2.0 * side;
  const bool has_bed = view.x_max > view.x_min;
  const double scale = has_bed ? place_bed(view, 0.0, 0.0, available).camera.scale : 1.0;
  const double room = broken ? available : std::numeric_limits<double>::infinity();

  const Group title = text_group(view.title, room, em, font);
  // If the furniture below shows no gravity arrow, the caption shows one.
  const bool arrow_above = has_bed && view.scale_label.empty() && !view.caption.empty();
  const Group caption = arrow_above ? text_with_arrow_group(view.caption, room, em, font)
                                    : text_group(view.caption, room, em, font, true);
  const Group scale_and_arrow = scale_group(view, scale, em, font);
  const std::vector<Group> legends = legend_groups(view.legends, room, em, font);
  for (const Group* group : {&title, &caption, &scale_and_arrow})
    if (group->width > available) return std::nullopt;
  for (const Group& group : legends)
    if (group.width > available) return std::nullopt;

  double y = std::ceil(0.5 * em);
  if (title.height + caption.height > 0.0)
    y = std::ceil(add_rows(layout, {title}, caption, y, side) + 0.4 * em);
  if (has_bed) {
    if (limits.own_turn && view.turn > 0.0)
      y -= room_above(layout, view, place_bed(view, side, y, available, true));
    move_by(layout, 0.0, std::max(y, limits.bed_top) - y);
    layout.bed = place_bed(view, side, std::max(y, limits.bed_top), available, limits.own_turn);
    y = layout.bed.box.bottom();
  }
  if (!legends.empty() || scale_and_arrow.height > 0.0)
    y = add_rows(layout, legends, scale_and_arrow, std::ceil(y + 0.6 * em), side);
  if (!view.traces.empty()) {
    y = std::max(std::ceil(y + 0.6 * em), limits.traces_top);
    layout.traces_top = y;
    y = add_traces(layout, view.traces, {side, width - side, y, broken, view.trace_height}, font);
    if (y < 0.0) return std::nullopt;
  }
  layout.height = checked_height(width, std::ceil(y + 0.5 * em));
  return layout;
}

}  // namespace

double base_line_of(const PlacedText& text, double em) { return std::round(text.box.y + text_ascent * em); }

void move_by(Layout& layout, double x, double y) {
  const auto move = [x, y](auto& place) {
    place.x += x;
    place.y += y;
  };
  for (PlacedText& text : layout.texts) move(text.box);
  for (PlacedSwatch& swatch : layout.swatches) move(swatch.box);
  for (PlacedBar& bar : layout.bars) {
    move(bar.box);
    for (double& tick : bar.ticks) tick += x;
  }
  for (Box* box : {&layout.scale_bar, &layout.arrow, &layout.bed.box})
    if (box->width > 0.0) move(*box);
  layout.bed.camera.origin_x += x;
  layout.bed.camera.origin_y += y;
  for (PlacedTrace& trace : layout.traces) {
    move(trace.box);
    move(trace.mark);
    for (Point& point : trace.curve) move(point);
    for (double& tick : trace.x_ticks) tick += x;
    for (double& tick : trace.y_ticks) tick += y;
    trace.event += x;
  }
}

Layout lay_out(const FrameView& view, int width, const Font& font, const LayoutLimits& limits) {
  if (width < smallest_width || width > largest_side)
    throw Error(ExitCode::usage,
                fmt::format("width = {}: expected {} ... {} px", width, smallest_width, largest_side));
  if (!view.furniture) return lay_out_bed(view, width);
  // Lines are broken at the same font size whether or not other pictures limit it, so that all pictures of a
  // panel share one size.
  const double wanted_em = std::max(10.0, std::round(width / view.letters));
  for (const bool broken : {false, true})
    for (double em = std::min(wanted_em, limits.largest_em);
         em >= std::max(width / view.max_letters, broken ? smallest_em : min_unbroken * wanted_em); em -= 0.5)
      if (std::optional<Layout> layout = lay_out_with(view, width, em, broken, font, limits)) return *layout;
  throw Error(ExitCode::usage,
              fmt::format("width = {}: the caption and legend of this map do not fit; use a larger width{}",
                          width, std::isfinite(view.max_letters) ? " in print" : ""));
}

LayoutLimits level(std::span<const FrameView> views, int width, const Font& font, LayoutLimits limits) {
  for (const FrameView& view : views)
    limits.bed_top = std::max(limits.bed_top, lay_out(view, width, font, limits).bed.box.y);
  for (const FrameView& view : views)
    limits.traces_top = std::max(limits.traces_top, lay_out(view, width, font, limits).traces_top);
  return limits;
}

}  // namespace talus::render
