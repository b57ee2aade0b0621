#include "render/layout.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <optional>

#include "base/errors.h"
#include "render/layout_groups.h"

namespace talus::render {
namespace {

// The curves below a map.

/// The part of a picture that is available to traces, px, and whether their titles may be broken into lines.
struct TraceRoom {
  double left = 0.0, right = 0.0, top = 0.0;
  bool broken = false;
  double frame_height = 5.0;  ///< height in font sizes
};

// Lengths in units of the font size.
constexpr double label_gap = 0.4;
constexpr double gap_below_frame = 0.65;  // the lowest label left of the frame extends half a line below it
constexpr double narrowest_frame = 8.0;
constexpr double gap_between_labels = 0.8;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Returns the relative position of a value in a range; 0.5 if the range is empty.
double share_of(double value, double low, double high) {
  return high > low ? (value - low) / (high - low) : 0.5;
}

double x_of(const Trace& trace, const Box& box, double value) {
  return box.x + box.width * share_of(value, trace.x_min, trace.x_max);
}

double y_of(const Trace& trace, const Box& box, double value) {
  return box.bottom() - box.height * share_of(value, trace.y_min, trace.y_max);
}

/// Interpolates the curve at x; NaN outside its range.
double value_at(const Trace& trace, double x) {
  if (trace.x.empty() || !(x >= trace.x.front() && x <= trace.x.back())) return nan;
  const auto above = std::lower_bound(trace.x.begin(), trace.x.end(), x);
  const auto k = static_cast<std::size_t>(above - trace.x.begin());
  if (*above == x) return trace.y[k];
  return trace.y[k - 1] +
         (trace.y[k] - trace.y[k - 1]) * (x - trace.x[k - 1]) / (trace.x[k] - trace.x[k - 1]);
}

double widest_label(const std::vector<Trace>& traces, double em, const Font& font) {
  double widest = 0.0;
  for (const Trace& trace : traces)
    for (const AxisTick& tick : trace.y_ticks)
      widest = std::max(widest, set_text(font, tick.label, em).width);
  return widest;
}

/// Adds labels left of the frame, from the lowest upwards, as long as they fit.
void add_y_labels(Layout& layout, const Trace& trace, const PlacedTrace& placed, const Font& font) {
  const double em = layout.em;
  double lowest_free = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < trace.y_ticks.size(); ++k) {
    PlacedText text =
        place_text(trace.y_ticks[k].label, 0.0, placed.y_ticks[k] - 0.5 * line_height * em, em, font);
    text.box.x = placed.box.x - label_gap * em - text.box.width;
    const bool room = text.box.bottom() <= lowest_free && text.box.y >= placed.box.y - 0.5 * line_height * em;
    if (!room) continue;
    lowest_free = text.box.y;
    layout.texts.push_back(std::move(text));
  }
}

/// Adds labels below the frame, from left to right, as long as they fit, and then the title of the axis.
double add_x_labels(Layout& layout, const Trace& trace, const PlacedTrace& placed, double right,
                    const Font& font) {
  const double em = layout.em;
  const double y = std::ceil(placed.box.bottom() + gap_below_frame * em);
  double first_free = 0.0;
  for (std::size_t k = 0; k < trace.x_ticks.size(); ++k) {
    PlacedText text = place_text(trace.x_ticks[k].label, 0.0, y, em, font);
    text.box.x = std::min(placed.x_ticks[k] - 0.5 * text.box.width, right - text.box.width);
    if (text.box.x < first_free) continue;
    first_free = text.box.right() + gap_between_labels * em;
    layout.texts.push_back(std::move(text));
  }
  if (trace.x_title.empty()) return y + line_height * em;
  PlacedText title = place_text(trace.x_title, 0.0, y + line_height * em, em, font);
  title.box.x = std::max(0.0, placed.box.x + 0.5 * (placed.box.width - title.box.width));
  layout.texts.push_back(title);
  return title.box.bottom();
}

/// Adds the name of the event above the frame if the title leaves room for it.
void add_event_label(Layout& layout, const Trace& trace, const PlacedTrace& placed, const Box& title,
                     double right, const Font& font) {
  if (trace.event_label.empty() || !(placed.event >= placed.box.x && placed.event <= placed.box.right()))
    return;
  PlacedText label = place_text(trace.event_label, 0.0, title.y, layout.em, font);
  label.box.x = std::min(placed.event - 0.5 * label.box.width, right - label.box.width);
  if (label.box.x >= title.right() + gap_between_labels * layout.em) layout.texts.push_back(label);
}

PlacedTrace place_trace(const Trace& trace, const Box& box) {
  PlacedTrace placed;
  placed.box = box;
  for (const AxisTick& tick : trace.x_ticks) placed.x_ticks.push_back(x_of(trace, box, tick.value));
  for (const AxisTick& tick : trace.y_ticks) placed.y_ticks.push_back(y_of(trace, box, tick.value));
  for (std::size_t k = 0; k < trace.x.size(); ++k)
    placed.curve.push_back({x_of(trace, box, trace.x[k]), y_of(trace, box, trace.y[k])});
  placed.mark = {x_of(trace, box, trace.mark), y_of(trace, box, value_at(trace, trace.mark))};
  if (trace.event >= trace.x_min && trace.event <= trace.x_max) placed.event = x_of(trace, box, trace.event);
  return placed;
}

/// Lays out traces one below the other; the last carries the labels of all. Labels that would touch are
/// omitted. Returns the lower edge, px; negative if nothing legible fits.
double add_traces(Layout& layout, const std::vector<Trace>& traces, const TraceRoom& room, const Font& font) {
  const double em = layout.em, right = room.right;
  const double frame_left = std::ceil(room.left + widest_label(traces, em, font) + label_gap * em);
  if (!traces.empty() && right - frame_left < narrowest_frame * em) return -1.0;
  double y = room.top;
  for (std::size_t k = 0; k < traces.size(); ++k) {
    const Trace& trace = traces[k];
    const double width = room.broken ? right - frame_left : std::numeric_limits<double>::infinity();
    const Group title = text_group(trace.title, width, em, font);
    if (title.width > right - frame_left) return -1.0;
    add_group(layout, title, frame_left, y);
    const double title_bottom = y + std::max(title.height, line_height * em);
    const Box last_line =
        title.texts.empty() ? Box{frame_left, y, 0.0, line_height * em} : layout.texts.back().box;
    const Box box{frame_left, std::ceil(title_bottom + 0.3 * em), std::floor(right - frame_left),
                  std::round(room.frame_height * em)};
    layout.traces.push_back(place_trace(trace, box));
    add_event_label(layout, trace, layout.traces.back(), last_line, right, font);
    add_y_labels(layout, trace, layout.traces.back(), font);
    y = box.bottom();
    if (k + 1 == traces.size()) y = add_x_labels(layout, trace, layout.traces.back(), right, font);
    y = std::ceil(y + 0.4 * em);
  }
  return y;
}

// Lengths in units of the font size.
constexpr double margin = 0.8;
constexpr double gap_between_rows = 0.3;
constexpr double gap_above_bed = 0.4;

constexpr double smallest_em = 6.0;  // px; smaller type is illegible
/// Smallest relative font size that is tried before lines are broken.
constexpr double min_unbroken = 0.8;

/// Places groups from left to right, `last` at the right end, in as many rows as they need, and `last` not
/// above `last_top`. Returns the lower edge, px.
double add_rows(Layout& layout, const std::vector<Group>& groups, const Group& last, double y, double side,
                double last_top = 0.0) {
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
    y = std::max(y, last_top);
    add_group(layout, last, std::floor(right - last.width), y);
    bottom = std::max(bottom, y + last.height);
  }
  return std::ceil(bottom);
}

/// Returns the height, px. Throws Error(usage) if it exceeds largest_side.
int checked_height(int width, double height) {
  if (height > largest_side)
    throw Error(ExitCode::usage,
                "a picture of this bed that is {} px wide would be {} px high; at most {} px are possible: "
                "use a smaller width",
                width, std::llround(height), largest_side);
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
double room_above(const Layout& layout, const Window& bed) {
  Layout below;
  below.bed = bed;
  const double room = std::min(bed.box.y - std::ceil(0.5 * layout.em),
                               room_between(layout, below, layout.width) - gap_above_bed * layout.em);
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
  const Group caption = has_bed && view.arrow_in_caption && !view.caption.empty()
                            ? text_with_arrow_group(view.caption, room, em, font)
                            : text_group(view.caption, room, em, font, true);
  const Group scale_and_arrow = scale_group(view, scale, em, font);
  const std::vector<Group> legends = legend_groups(view.legends, room, em, font);
  for (const Group* group : {&title, &caption, &scale_and_arrow})
    if (group->width > available) return std::nullopt;
  for (const Group& group : legends)
    if (group.width > available) return std::nullopt;

  double y = std::ceil(0.5 * em);
  if (title.height + caption.height > 0.0) {
    y = limits.own_turn && view.turn_max > 0.0
            ? add_rows(layout, {title, caption}, {}, y, side)
            : add_rows(layout, {title}, caption, y, side, limits.caption_top);
    if (!caption.texts.empty())
      layout.caption_top = layout.texts[layout.texts.size() - caption.texts.size()].box.y;
    y = std::ceil(y + gap_above_bed * em);
  }
  if (has_bed) {
    if (limits.own_turn && view.turn > 0.0)
      y -= room_above(layout, place_bed(view, side, y, available, true));
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
  const bool heading = !has_bed && view.legends.empty() && view.traces.empty();  // belongs to what follows
  layout.height = checked_height(width, std::ceil(heading ? y : y + 0.5 * em));
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

std::vector<Point> seen_corners(const Window& window) {
  if (window.camera.sine == 0.0) {
    const Box& box = window.box;
    return {{box.x, box.y}, {box.right(), box.y}, {box.right(), box.bottom()}, {box.x, box.bottom()}};
  }
  const Camera& camera = window.camera;
  return {camera.project(window.x_min, window.y_min), camera.project(window.x_max, window.y_min),
          camera.project(window.x_max, window.y_max), camera.project(window.x_min, window.y_max)};
}

namespace {

/// The highest and the lowest point of a picture at one x, px from the top.
struct Extent {
  double top = std::numeric_limits<double>::infinity(), bottom = -top;
};

Extent extent_at(const Layout& layout, double x) {
  Extent extent;
  const auto add_edge = [&](const Point& from, const Point& to) {
    if (from.x == to.x || x < std::min(from.x, to.x) || x > std::max(from.x, to.x)) return;
    const double y = std::lerp(from.y, to.y, (x - from.x) / (to.x - from.x));
    extent = {std::min(extent.top, y), std::max(extent.bottom, y)};
  };
  const auto add_box = [&](const Box& box) {
    add_edge({box.x, box.y}, {box.right(), box.y});
    add_edge({box.x, box.bottom()}, {box.right(), box.bottom()});
  };
  for (const PlacedText& text : layout.texts) add_box(text.box);
  for (const PlacedBar& bar : layout.bars) add_box(bar.box);
  add_box(layout.arrow);
  const std::vector<Point> corners = seen_corners(layout.bed);
  for (std::size_t k = 0; k < corners.size(); ++k) add_edge(corners[k], corners[(k + 1) % corners.size()]);
  return extent;
}

}  // namespace

double room_between(const Layout& above, const Layout& below, int width) {
  double room = std::numeric_limits<double>::infinity();
  for (int x = 0; x < width; ++x) room = std::min(room, extent_at(below, x).top - extent_at(above, x).bottom);
  return room;
}

Layout lay_out(const FrameView& view, int width, const Font& font, const LayoutLimits& limits) {
  if (width < smallest_width || width > largest_side)
    throw Error(ExitCode::usage, "width = {}: expected {} ... {} px", width, smallest_width, largest_side);
  if (!view.furniture) return lay_out_bed(view, width);
  // Lines are broken at the same font size whether or not other pictures limit it, so that all pictures of a
  // panel share one size.
  const double wanted_em = std::max(10.0, std::round(width / view.letters));
  for (const bool broken : {false, true})
    for (double em = std::min(wanted_em, limits.largest_em);
         em >= std::max(width / view.max_letters, broken ? smallest_em : min_unbroken * wanted_em); em -= 0.5)
      if (std::optional<Layout> layout = lay_out_with(view, width, em, broken, font, limits)) return *layout;
  throw Error(ExitCode::usage,
              "width = {}: the caption and legend of this map do not fit; use a larger width{}", width,
              std::isfinite(view.max_letters) ? " in print" : "");
}

LayoutLimits level(std::span<const FrameView> views, int width, const Font& font, LayoutLimits limits) {
  for (const FrameView& view : views)
    limits.caption_top = std::max(limits.caption_top, lay_out(view, width, font, limits).caption_top);
  for (const FrameView& view : views)
    limits.bed_top = std::max(limits.bed_top, lay_out(view, width, font, limits).bed.box.y);
  for (const FrameView& view : views)
    limits.traces_top = std::max(limits.traces_top, lay_out(view, width, font, limits).traces_top);
  return limits;
}

}  // namespace talus::render
