#pragma once
/// A bed at several angles in one picture, a column for each map, as in the paper's Figs. 10 and 13.

#include <string>
#include <vector>

#include "pictures/picture_marks.h"
#include "render/layout.h"

namespace talus::pictures {

/// Draws the frames nearest to the angles of `at` (frames_at), each as wide as the plan says, into a PNG
/// file. Returns how many there are, and whether the file was there before. Throws as frames_at and is_drawn
/// do.
struct PanelDrawn {
  std::size_t angles = 0;
  bool there_before = false;
};
PanelDrawn draw_panel(DrawnRun& run, const std::vector<std::string>& at, const std::string& output,
                      bool overwrite);

/// The layout of a panel of pictures of that width: the letters of all have one size, which goes by the width
/// of the panel, and the beds and traces of a row are level. Returns the limits of each row.
std::vector<render::LayoutLimits> level_rows(std::vector<std::vector<render::FrameView>>& rows, int width,
                                             const render::Font& font);

}  // namespace talus::pictures
