#pragma once
/// Pictures of discs for measuring drawing, the same for Talus and for its peers.

#include <string>

#include "render/frame_view.h"

namespace talus::bench {

/// Numbers of discs and width of a measured picture; the height is a quarter of the width.
struct PictureSize {
  int columns, rows;
  int width;  ///< px
  int discs() const { return columns * rows; }
};
inline constexpr PictureSize paper_picture{200, 40, 1600};   ///< 8000 discs, the paper's bed
inline constexpr PictureSize large_picture{800, 125, 4000};  ///< 100 000 discs

/// Returns a bed of discs of different sizes and shades with gray rims at the bottom of a picture without
/// furniture, in gray or in viridis.
render::FrameView picture(const PictureSize& size, bool coloured);

/// Writes the discs as CSV in drawing order, in px from the left and from the bottom: x, y, radius, and red,
/// green and blue of fill and rim, 0 ... 255. Throws Error(cannot_create).
void write_discs(const std::string& path, const render::FrameView& view, int width);

}  // namespace talus::bench
