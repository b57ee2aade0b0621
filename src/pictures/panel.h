#pragma once
/// A bed at several angles in one picture, a column for each map, as in the paper's Figs. 10 and 13.

#include <string>
#include <vector>

#include "pictures/picture_marks.h"
#include "render/sheet.h"

namespace talus::pictures {

struct PanelAsked {
  std::vector<std::string> at;  ///< as in frames_at
  std::string title;            ///< above all; empty: none
  std::string output;           ///< FILE.png, FILE.pdf or FILE.svg
  bool overwrite = false;
};

/// Draws the frames nearest to the angles, a row for each, on a sheet as wide as the plan says. Returns how
/// many there are, and whether the file was there before. Throws as frames_at, panel_sheet and is_drawn do.
struct PanelDrawn {
  std::size_t angles = 0;
  bool there_before = false;
};
PanelDrawn draw_panel(DrawnRun& run, const PanelAsked& asked);

/// The rows of a panel from its maps (a row for each angle, at least one, all of the same length), with so
/// many angles beside each other: what all angles say in the title of a map and what all captions say stands
/// once above them, with `title` over it; legends that are the same, and the scale bar, stand once below.
/// Maps have letters (a), (b), ... if there are several. Those without furniture stay without.
std::vector<std::vector<render::FrameView>> panel_rows(std::vector<std::vector<render::FrameView>> maps,
                                                       const std::string& title, std::size_t beside = 1);

/// A panel as a sheet, with a row for each angle; if it would be higher than `highest` (px), with more angles
/// beside each other, as far as it gets lower and all texts have room. Throws as lay_out does, and
/// Error(usage) if the sheet is higher than largest_side.
render::Sheet panel_sheet(const std::vector<std::vector<render::FrameView>>& maps, const std::string& title,
                          int width, int highest, const render::Font& font);

}  // namespace talus::pictures
