#pragma once
/// Whether a picture is laid out so that it can be read.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "render/layout.h"

namespace talus::test {

struct NamedBox {
  Box box;
  std::string name;
};

inline std::vector<NamedBox> all_boxes(const Layout& layout) {
  std::vector<NamedBox> boxes = {{layout.bed.box, "bed"}};
  if (layout.scale_bar.width > 0.0) boxes.push_back({layout.scale_bar, "scale bar"});
  if (layout.arrow.width > 0.0) boxes.push_back({layout.arrow, "arrow"});
  for (const PlacedBar& bar : layout.bars) boxes.push_back({bar.box, "bar"});
  for (const PlacedText& text : layout.texts) boxes.push_back({text.box, "text \"" + text.text + "\""});
  for (const PlacedSwatch& swatch : layout.swatches) boxes.push_back({swatch.box, "swatch"});
  for (const PlacedTrace& trace : layout.traces) boxes.push_back({trace.box, "trace"});
  return boxes;
}

inline bool overlap(const Box& a, const Box& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

/// Everything inside the picture, and nothing over anything else.
inline void expect_tidy(const Layout& layout, const std::string& what) {
  const std::vector<NamedBox> boxes = all_boxes(layout);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box& box = boxes[i].box;
    EXPECT_GT(box.width * box.height, 0.0) << what << ", " << boxes[i].name;
    EXPECT_GE(box.x, 0.0) << what << ", " << boxes[i].name;
    EXPECT_GE(box.y, 0.0) << what << ", " << boxes[i].name;
    EXPECT_LE(box.right(), layout.width) << what << ", " << boxes[i].name;
    EXPECT_LE(box.bottom(), layout.height) << what << ", " << boxes[i].name;
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(overlap(box, boxes[j].box)) << what << ", " << boxes[j].name << " and " << boxes[i].name;
  }
}

}  // namespace talus::test
