#include "render/layout.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/errors.h"

namespace talus {
namespace {

// In units of the font size.
constexpr double line_height = text_ascent + text_descent;
constexpr double margin = 0.8;
constexpr double gap_between_groups = 2.0;
constexpr double gap_in_group = 0.6;
constexpr double bar_height = 0.9;
constexpr double tick_length = 0.3;
constexpr double shortest_bar = 12.0;
constexpr double arrow_size = 2.4;

constexpr double smallest_em = 6.0;  // px: below, nothing can be read

/// A part of the furniture, laid out at (0, 0).
struct Group {
  double width = 0.0, height = 0.0;
  std::vector<PlacedText> texts;
  Box bar;
  std::vector<double> ticks;
  std::vector<PlacedSwatch> swatches;
  Box scale_bar;
  Box arrow;
};

/// Places text with its upper left corner at (x, y).
PlacedText place_text(const std::string& text, double x, double y, double em, const Font& font) {
  return {{x, y, set_text(font, text, em).width, line_height * em}, text};
}

Group text_group(const std::string& text, double em, const Font& font) {
  Group group;
  if (text.empty()) return group;
  group.texts.push_back(place_text(text, 0.0, 0.0, em, font));
  group.width = group.texts[0].box.width;
  group.height = line_height * em;
  return group;
}

Group bar_group(const FrameView& view, double em, const Font& font) {
  Group group;
  std::vector<double> widths;
  for (const BarTick& tick : view.bar_ticks) widths.push_back(set_text(font, tick.label, em).width);
  double length = shortest_bar * em;
  for (std::size_t k = 1; k < widths.size(); ++k)
    length = std::max(length, (0.5 * (widths[k - 1] + widths[k]) + gap_in_group * em) /
                                  (view.bar_ticks[k].shade - view.bar_ticks[k - 1].shade));
  length = std::ceil(length);

  const PlacedText title = place_text(view.bar_title, 0.0, 0.0, em, font);
  double left = title.box.width + (view.bar_title.empty() ? 0.0 : gap_in_group * em);
  for (std::size_t k = 0; k < widths.size(); ++k)
    left = std::max(left, 0.5 * widths[k] - view.bar_ticks[k].shade * length);
  left = std::ceil(left);
  if (!view.bar_title.empty()) group.texts.push_back(title);
  group.bar = {left, std::round(0.5 * (line_height - bar_height) * em), length, std::round(bar_height * em)};
  group.width = group.bar.right();
  const double labels_top = std::ceil(std::max(group.bar.bottom() + tick_length * em, line_height * em));
  for (std::size_t k = 0; k < widths.size(); ++k) {
    const double x = left + view.bar_ticks[k].shade * length;
    group.ticks.push_back(x);
    group.texts.push_back(place_text(view.bar_ticks[k].label, x - 0.5 * widths[k], labels_top, em, font));
    group.width = std::max(group.width, group.texts.back().box.right());
  }
  group.height = labels_top + line_height * em;
  return group;
}

Group swatch_group(const FrameView& view, double em, const Font& font) {
  Group group;
  group.height = line_height * em;
  double x = 0.0;
  for (const Swatch& swatch : view.swatches) {
    const double side = 0.9 * em;
    group.swatches.push_back({{x, 0.5 * (group.height - side), side, side}, swatch.shade});
    group.texts.push_back(place_text(swatch.label, x + side + 0.5 * gap_in_group * em, 0.0, em, font));
    group.width = group.texts.back().box.right();
    x = group.width + gap_between_groups * em;
  }
  return group;
}

/// The scale bar with its label below, and the gravity arrow with its label.
Group scale_group(const FrameView& view, double scale, double em, const Font& font) {
  Group group;
  const double length = std::round(view.scale_length * scale);
  const double label = set_text(font, view.scale_label, em).width;
  const double width = std::max(length, label);
  const double bar = std::round(0.5 * em);
  group.scale_bar = {0.5 * (width - length), 0.5 * (line_height * em - bar), length, bar};
  group.texts.push_back(place_text(view.scale_label, 0.5 * (width - label), line_height * em, em, font));
  const PlacedText gravity =
      place_text("g", width + gap_between_groups * em, 0.5 * (arrow_size - line_height) * em, em, font);
  group.texts.push_back(gravity);
  group.arrow = {gravity.box.right() + 0.5 * gap_in_group * em, 0.0, arrow_size * em, arrow_size * em};
  group.width = group.arrow.right();
  group.height = std::max(2.0 * line_height, arrow_size) * em;
  return group;
}

void add_group(Layout& layout, const Group& group, double x, double y) {
  const auto moved = [&](Box box) { return Box{box.x + x, box.y + y, box.width, box.height}; };
  for (const PlacedText& text : group.texts) layout.texts.push_back({moved(text.box), text.text});
  for (const PlacedSwatch& swatch : group.swatches)
    layout.swatches.push_back({moved(swatch.box), swatch.shade});
  for (double tick : group.ticks) layout.ticks.push_back(tick + x);
  if (group.bar.width > 0.0) layout.bar = moved(group.bar);
  if (group.scale_bar.width > 0.0) layout.scale_bar = moved(group.scale_bar);
  if (group.arrow.width > 0.0) layout.arrow = moved(group.arrow);
}

/// Puts two groups at the ends of one row, or below each other where they do not fit. Returns the lower edge.
double add_row(Layout& layout, const Group& left, const Group& right, double y, double side) {
  const double available = layout.width - 2.0 * side;
  const bool one_row = left.width + gap_between_groups * layout.em + right.width <= available;
  add_group(layout, left, side, y);
  const double right_y = one_row || left.height == 0.0 ? y : y + std::ceil(left.height + 0.3 * layout.em);
  add_group(layout, right, std::floor(layout.width - side - right.width), right_y);
  return std::ceil(std::max(y + left.height, right_y + right.height));
}

/// The height, px, unless it is above largest_side.
int checked_height(int width, double height) {
  if (height > largest_side)
    throw Error(ExitCode::usage, "a picture " + std::to_string(width) + " px wide of this bed would be " +
                                     std::to_string(std::llround(height)) + " px high; at most " +
                                     std::to_string(largest_side) +
                                     " px are possible: ask for a smaller width");
  return static_cast<int>(height);
}

/// A picture of the bed alone.
Layout lay_out_bed(const FrameView& view, int width) {
  Layout layout;
  layout.width = width;
  layout.camera.scale = width / (view.x_max - view.x_min);
  const double height = std::ceil((view.y_max - view.y_min) * layout.camera.scale);
  layout.height = checked_height(width, height);
  layout.bed = {0.0, 0.0, static_cast<double>(width), height};
  layout.camera.origin_x = -view.x_min * layout.camera.scale;
  layout.camera.origin_y = height + view.y_min * layout.camera.scale;
  return layout;
}

/// The layout in one font size, if everything fits its width.
std::optional<Layout> lay_out_with(const FrameView& view, int width, double em, const Font& font) {
  Layout layout;
  layout.width = width;
  layout.em = em;
  const double side = std::ceil(margin * em);
  const double available = width - 2.0 * side;
  layout.camera.scale = available / (view.x_max - view.x_min);

  const Group title = text_group(view.title, em, font);
  const Group caption = text_group(view.caption, em, font);
  const Group legend = view.bar_ticks.empty() ? swatch_group(view, em, font) : bar_group(view, em, font);
  const Group scale = scale_group(view, layout.camera.scale, em, font);
  for (const Group* group : {&title, &caption, &legend, &scale})
    if (group->width > available) return std::nullopt;

  const double bed_top = std::ceil(add_row(layout, title, caption, std::ceil(0.5 * em), side) + 0.4 * em);
  layout.bed = {side, bed_top, available, std::ceil((view.y_max - view.y_min) * layout.camera.scale)};
  layout.camera.origin_x = side - view.x_min * layout.camera.scale;
  layout.camera.origin_y = layout.bed.bottom() + view.y_min * layout.camera.scale;
  const double bottom = add_row(layout, legend, scale, std::ceil(layout.bed.bottom() + 0.6 * em), side);
  layout.height = checked_height(width, std::ceil(bottom + 0.5 * em));
  return layout;
}

}  // namespace

Layout lay_out(const FrameView& view, int width, const Font& font) {
  if (width < smallest_width || width > largest_side)
    throw Error(ExitCode::usage, "width = " + std::to_string(width) + ": expected " +
                                     std::to_string(smallest_width) + " ... " + std::to_string(largest_side) +
                                     " px");
  if (!view.furniture) return lay_out_bed(view, width);
  for (double em = std::max(10.0, std::round(width / 90.0)); em >= smallest_em; em -= 0.5)
    if (std::optional<Layout> layout = lay_out_with(view, width, em, font)) return *layout;
  throw Error(ExitCode::usage, "width = " + std::to_string(width) +
                                   ": caption and legend of this map do not fit; ask for a larger width");
}

}  // namespace talus
