#include "render/layout_groups.h"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

// In units of the font size.
constexpr double gap_in_group = 0.6;
constexpr double bar_height = 0.9;
constexpr double tick_length = 0.3;
constexpr double shortest_bar = 12.0;
constexpr double arrow_size = 2.4;
constexpr double swatch_side = 0.9;
constexpr double line_swatch_width = 1.8;

Box moved(const Box& box, double x, double y) { return {box.x + x, box.y + y, box.width, box.height}; }

/// So long that the labels of neighbouring ticks do not touch, px.
double bar_length(const Bar& bar, const std::vector<double>& label_widths, double em) {
  double length = shortest_bar * em;
  for (std::size_t k = 1; k < label_widths.size(); ++k)
    length = std::max(length, (0.5 * (label_widths[k - 1] + label_widths[k]) + gap_in_group * em) /
                                  (bar.ticks[k].share - bar.ticks[k - 1].share));
  return std::ceil(length);
}

}  // namespace

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

Group text_with_arrow_group(const std::string& text, double em, const Font& font) {
  Group group = text_group(text, em, font);
  const double side = std::floor(line_height * em);
  group.arrow = {group.width + gap_in_group * em, 0.0, side, side};
  group.width = group.arrow.right();
  return group;
}

Group bar_group(const Bar& bar, double em, const Font& font) {
  Group group;
  std::vector<double> widths;
  for (const BarTick& tick : bar.ticks) widths.push_back(set_text(font, tick.label, em).width);
  const double length = bar_length(bar, widths, em);
  const PlacedText title = place_text(bar.title, 0.0, 0.0, em, font);
  double left = title.box.width + (bar.title.empty() ? 0.0 : gap_in_group * em);
  for (std::size_t k = 0; k < widths.size(); ++k)
    left = std::max(left, 0.5 * widths[k] - bar.ticks[k].share * length);
  left = std::ceil(left);
  if (!bar.title.empty()) group.texts.push_back(title);
  PlacedBar placed;
  placed.box = {left, std::round(0.5 * (line_height - bar_height) * em), length, std::round(bar_height * em)};
  placed.colours = bar.colours;
  group.width = placed.box.right();
  const double labels_top = std::ceil(std::max(placed.box.bottom() + tick_length * em, line_height * em));
  for (std::size_t k = 0; k < widths.size(); ++k) {
    const double x = left + bar.ticks[k].share * length;
    placed.ticks.push_back(x);
    group.texts.push_back(place_text(bar.ticks[k].label, x - 0.5 * widths[k], labels_top, em, font));
    group.width = std::max(group.width, group.texts.back().box.right());
  }
  group.bars.push_back(std::move(placed));
  group.height = labels_top + line_height * em;
  return group;
}

Group swatch_group(const Swatch& swatch, double em, const Font& font) {
  Group group;
  group.height = line_height * em;
  const double side = swatch_side * em;
  const double width = swatch.kind == Swatch::Kind::line ? line_swatch_width * em : side;
  group.swatches.push_back({{0.0, 0.5 * (group.height - side), width, side}, swatch});
  group.texts.push_back(place_text(swatch.label, width + 0.5 * gap_in_group * em, 0.0, em, font));
  group.width = group.texts.back().box.right();
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
  const PlacedText gravity =
      place_text("g", width + gap_between_groups * em, 0.5 * (arrow_size - line_height) * em, em, font);
  group.texts.push_back(gravity);
  group.arrow = {gravity.box.right() + 0.5 * gap_in_group * em, 0.0, arrow_size * em, arrow_size * em};
  group.width = group.arrow.right();
  group.height = std::max(2.0 * line_height, arrow_size) * em;
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

}  // namespace talus
