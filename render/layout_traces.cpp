#include "render/layout_traces.h"

#include <algorithm>
#include <cmath>

#include "render/layout_groups.h"

namespace talus::render {
namespace {

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

}  // namespace

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

}  // namespace talus::render
