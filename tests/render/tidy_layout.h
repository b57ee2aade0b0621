#pragma once
/// Checks whether the layout of a picture is legible.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "render/layout.h"

namespace talus::test {

struct NamedBox {
  render::Box box;
  std::string name;
  int part = 0;  ///< boxes of one part may touch, such as a bar and its ticks
};

inline render::Box grown(const render::Box& box, double by) {
  return {box.x - by, box.y - by, box.width + 2.0 * by, box.height + 2.0 * by};
}

/// Returns the width (px) of the lines of axes and legends.
inline double line_width(const render::Layout& layout) { return std::max(1.0, std::round(layout.em / 12.0)); }

/// Returns everything drawn, with lines, ticks and walls.
inline std::vector<NamedBox> all_boxes(const render::Layout& layout) {
  const double line = line_width(layout), tick = std::round(0.3 * layout.em);
  std::vector<NamedBox> boxes = {{layout.bed.box, "bed"}};
  const auto add = [&](const render::Box& box, const std::string& name) {
    boxes.push_back({box, name, static_cast<int>(boxes.size())});
  };
  if (layout.scale_bar.width > 0.0) add(layout.scale_bar, "scale bar");
  if (layout.arrow.width > 0.0) add(layout.arrow, "arrow");
  for (const render::PlacedBar& bar : layout.bars) {
    add(grown(bar.box, line), "bar");
    const int part = boxes.back().part;
    for (const double x : bar.ticks)
      boxes.push_back({{x - 0.5 * line, bar.box.bottom(), line, tick}, "tick of a bar", part});
  }
  for (const render::PlacedText& text : layout.texts) add(text.box, "text \"" + text.text + "\"");
  for (const render::PlacedSwatch& swatch : layout.swatches) add(swatch.box, "swatch");
  for (const render::PlacedTrace& trace : layout.traces) {
    const double disc = 0.3 * layout.em;  // size of the mark, which may lie at the edge of the frame
    render::Box drawn = grown(trace.box, line);
    if (!std::isnan(trace.mark.y)) {
      drawn.x = std::min(drawn.x, trace.mark.x - disc);
      drawn.width = std::max(trace.box.right() + line, trace.mark.x + disc) - drawn.x;
    }
    add(drawn, "trace");
  }
  return boxes;
}

inline bool overlap(const render::Box& a, const render::Box& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

inline std::string text_of(const render::Box& box) {
  return "(" + std::to_string(box.x) + ", " + std::to_string(box.y) + ") to (" + std::to_string(box.right()) +
         ", " + std::to_string(box.bottom()) + ")";
}

/// Returns whether a box does not overlap the bed, which may be turned: it lies beyond one side of the bed.
inline bool clear_of_bed(const render::Box& box, const render::Window& bed) {
  const auto bed_x = [&](const render::Point& p) {
    return (bed.camera.cosine * (p.x - bed.camera.origin_x) + bed.camera.sine * (p.y - bed.camera.origin_y)) /
           bed.camera.scale;
  };
  const auto bed_y = [&](const render::Point& p) {
    return (bed.camera.sine * (p.x - bed.camera.origin_x) - bed.camera.cosine * (p.y - bed.camera.origin_y)) /
           bed.camera.scale;
  };
  const render::Point corners[] = {
      {box.x, box.y}, {box.right(), box.y}, {box.x, box.bottom()}, {box.right(), box.bottom()}};
  const auto all = [&](const auto& beyond) {
    return std::all_of(std::begin(corners), std::end(corners), beyond);
  };
  return all([&](const render::Point& p) { return bed_x(p) < bed.x_min; }) ||
         all([&](const render::Point& p) { return bed_x(p) > bed.x_max; }) ||
         all([&](const render::Point& p) { return bed_y(p) < bed.y_min; }) ||
         all([&](const render::Point& p) { return bed_y(p) > bed.y_max; });
}

/// Returns the faults of a layout: parts outside the picture, overlaps, and texts on one line so close that
/// they read as one. Empty if there are none.
inline std::string untidy(const render::Layout& layout) {
  constexpr double between_texts = 0.35;  // em
  std::string wrong;
  const std::vector<NamedBox> boxes = all_boxes(layout);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const render::Box& box = boxes[i].box;
    if (!(box.width * box.height > 0.0)) wrong += boxes[i].name + " is empty\n";
    if (box.x < 0.0 || box.y < 0.0 || box.right() > layout.width || box.bottom() > layout.height)
      wrong += boxes[i].name + " leaves the picture: " + text_of(box) + "\n";
    for (std::size_t j = 0; j < i; ++j) {
      if (boxes[j].part == boxes[i].part) continue;
      if (j == 0 && clear_of_bed(box, layout.bed)) continue;
      const bool texts = boxes[i].name.starts_with("text") && boxes[j].name.starts_with("text");
      const double gap = texts ? between_texts * layout.em : 0.0;
      if (overlap({box.x - gap, box.y, box.width + 2.0 * gap, box.height}, boxes[j].box))
        wrong += boxes[j].name + " " + text_of(boxes[j].box) + " meets " + boxes[i].name + " " +
                 text_of(box) + "\n";
    }
  }
  return wrong;
}

inline void expect_tidy(const render::Layout& layout, const std::string& what) {
  EXPECT_EQ(untidy(layout), "") << what;
}

}  // namespace talus::test
