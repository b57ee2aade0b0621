#include "render/layout_groups.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace talus::render {
namespace {

// Lengths in units of the font size.
constexpr double gap_in_group = 0.6;
constexpr double bar_height = 0.9;
constexpr double tick_length = 0.3;
constexpr double shortest_bar = 12.0;
constexpr double arrow_size = 2.4;
constexpr double swatch_side = 0.9;
constexpr double line_swatch_width = 1.8;

Box moved(const Box& box, double x, double y) { return {box.x + x, box.y + y, box.width, box.height}; }

/// Returns the shortest length, px, at which the labels of neighbouring ticks do not touch.
double min_length(const Bar& bar, const std::vector<double>& widths, double em) {
  double length = 0.0;
  for (std::size_t k = 1; k < widths.size(); ++k)
    length = std::max(length, (0.5 * (widths[k - 1] + widths[k]) + gap_in_group * em) /
                                  (bar.ticks[k].share - bar.ticks[k - 1].share));
  return std::ceil(length);
}

std::vector<double> label_widths(const Bar& bar, double em, const Font& font) {
  std::vector<double> widths;
  for (const BarTick& tick : bar.ticks) widths.push_back(set_text(font, tick.label, em).width);
  return widths;
}

/// Drops every second tick until the labels fit.
Bar thinned(Bar bar, double room, double em, const Font& font) {
  const auto needed = [&] {
    const std::vector<double> widths = label_widths(bar, em, font);
    return min_length(bar, widths, em) + 0.5 * (widths.front() + widths.back());
  };
  while (bar.ticks.size() > 2 && needed() > room) {
    std::vector<BarTick> kept;
    for (std::size_t k = 0; k < bar.ticks.size(); k += 2) kept.push_back(bar.ticks[k]);
    bar.ticks = std::move(kept);
  }
  return bar;
}

/// Horizontal position of a bar, px.
struct BarEnds {
  double left = 0.0, length = 0.0;
  double right = 0.0;  ///< right end of the last label, if it extends beyond the bar
};

/// Returns the position of a bar that begins at `first` or, if its labels require it, further right.
BarEnds ends_of(const Bar& bar, const std::vector<double>& widths, double first, double length) {
  BarEnds ends{first, length, 0.0};
  for (std::size_t k = 0; k < widths.size(); ++k)
    ends.left = std::max(ends.left, 0.5 * widths[k] - bar.ticks[k].share * length);
  ends.left = std::ceil(ends.left);
  ends.right = ends.left + length;
  for (std::size_t k = 0; k < widths.size(); ++k)
    ends.right = std::max(ends.right, ends.left + bar.ticks[k].share * length + 0.5 * widths[k]);
  return ends;
}

/// Adds a bar in the line at `top`, with its ticks and labels, to the group of its title.
Group bar_at(const Bar& bar, const std::vector<double>& widths, Group title, const BarEnds& ends, double top,
             double em, const Font& font) {
  Group group = std::move(title);
  PlacedBar placed;
  placed.box = {ends.left, top + std::round(0.5 * (line_height - bar_height) * em), ends.length,
                std::round(bar_height * em)};
  placed.colours = bar.colours;
  const double labels_top =
      std::ceil(std::max(placed.box.bottom() + tick_length * em, top + line_height * em));
  for (std::size_t k = 0; k < widths.size(); ++k) {
    const double x = ends.left + bar.ticks[k].share * ends.length;
    placed.ticks.push_back(x);
    group.texts.push_back(place_text(bar.ticks[k].label, x - 0.5 * widths[k], labels_top, em, font));
  }
  group.bars.push_back(std::move(placed));
  group.width = std::max(group.width, ends.right);
  group.height = labels_top + line_height * em;
  return group;
}

}  // namespace

PlacedText place_text(const std::string& text, double x, double y, double em, const Font& font) {
  return {{x, y, set_text(font, text, em).width, line_height * em}, text};
}

Group text_group(const std::string& text, double room, double em, const Font& font, bool right_aligned) {
  Group group;
  const auto fits = [&](const std::string& line) { return set_text(font, line, em).width <= room; };
  for (const std::string& line : broken_lines(text, fits)) {
    group.texts.push_back(place_text(line, 0.0, group.height, em, font));
    group.width = std::max(group.width, group.texts.back().box.width);
    group.height += line_height * em;
  }
  if (right_aligned)
    for (PlacedText& line : group.texts) line.box.x = group.width - line.box.width;
  return group;
}

Group text_with_arrow_group(const std::string& text, double room, double em, const Font& font) {
  const double side = std::floor(line_height * em), gap = 0.5 * gap_in_group * em;
  Group group = text_group(text + "  g", room - side - gap, em, font, true);
  group.arrow = {group.width + gap, 0.0, side, side};
  group.width = group.arrow.right();
  return group;
}

Group bar_group(const Bar& whole, double room, double em, const Font& font) {
  const Bar bar = thinned(whole, room, em, font);
  const std::vector<double> widths = label_widths(bar, em, font);
  const double least = min_length(bar, widths, em);
  const double wanted = std::max(std::ceil(shortest_bar * em), least);
  const double title = set_text(font, bar.title, em).width;
  const double title_width = bar.title.empty() ? 0.0 : title + gap_in_group * em;
  const BarEnds plain = ends_of(bar, widths, title_width, wanted);
  if (plain.right <= room)
    return bar_at(bar, widths, text_group(bar.title, title, em, font), plain, 0.0, em, font);
  Group above = text_group(bar.title, room, em, font);
  BarEnds below = ends_of(bar, widths, 0.0, wanted);
  if (below.right > room)
    below = ends_of(bar, widths, 0.0, std::max(least, std::floor(wanted - (below.right - room))));
  const double top = std::ceil(above.height + 0.2 * em);
  return bar_at(bar, widths, std::move(above), below, top, em, font);
}

Group swatch_group(const Swatch& swatch, double room, double em, const Font& font) {
  const double side = swatch_side * em;
  const double width = swatch.kind == Swatch::Kind::line ? line_swatch_width * em : side;
  const double left = width + 0.5 * gap_in_group * em;
  Group group = text_group(swatch.label, room - left, em, font);
  for (PlacedText& line : group.texts) line.box.x += left;
  group.swatches.push_back({{0.0, 0.5 * (line_height * em - side), width, side}, swatch});
  group.width += left;
  return group;
}

Group scale_group(const FrameView& view, double scale, double em, const Font& font) {
  Group group;
  if (view.scale_label.empty()) return group;
  const double length = std::round(view.scale_length * scale);
  const double label = set_text(font, view.scale_label, em).width;
  const double width = std::max(length, label);
  const double bar = std::round(0.5 * em);
  group.scale_bar = {0.5 * (width - length), 0.5 * (line_height * em - bar), length, bar};
  group.texts.push_back(place_text(view.scale_label, 0.5 * (width - label), line_height * em, em, font));
  group.width = width;
  group.height = 2.0 * line_height * em;
  if (view.arrow_in_caption) return group;
  const PlacedText gravity =
      place_text("g", width + gap_between_groups * em, 0.5 * (arrow_size - line_height) * em, em, font);
  group.texts.push_back(gravity);
  group.arrow = {gravity.box.right() + 0.5 * gap_in_group * em, 0.0, arrow_size * em, arrow_size * em};
  group.width = group.arrow.right();
  group.height = std::max(group.height, arrow_size * em);
  return group;
}

void add_group(Layout& layout, const Group& group, double x, double y) {
  for (const PlacedText& text : group.texts) layout.texts.push_back({moved(text.box, x, y), text.text});
  for (const PlacedSwatch& swatch : group.swatches)
    layout.swatches.push_back({moved(swatch.box, x, y), swatch.swatch});
  for (const PlacedBar& bar : group.bars) {
    layout.bars.push_back({moved(bar.box, x, y), bar.colours, bar.ticks});
    for (double& tick : layout.bars.back().ticks) tick += x;
  }
  if (group.scale_bar.width > 0.0) layout.scale_bar = moved(group.scale_bar, x, y);
  if (group.arrow.width > 0.0) layout.arrow = moved(group.arrow, x, y);
}

}  // namespace talus::render
