#pragma once
/// A bed at several angles in one picture, with a column for each map, as in the paper's Figs. 10 and 13.

#include <string>
#include <vector>

#include "pictures/picture_series.h"
#include "render/sheet.h"

namespace talus::pictures {

struct PanelRequest {
  std::vector<std::string> at;  ///< entries of frames_at; empty: begin, halfway, and end of the tilt
  std::string title;            ///< title above everything; empty: none
  std::string output;           ///< FILE.png, FILE.pdf or FILE.svg
};

/// Throws Error(usage), which names a size that is large enough, if the maps of the plan do not fit next to
/// each other with the texts of the first frame, the only one that is read. Passes if --crop is given.
void check_panel(const std::string& path, const MapPlan& plan, const PanelRequest& asked);

/// Draws a row for each frame, and returns their number. Throws the errors of frames_at and check_panel.
std::size_t draw_panel(DrawnRun& run, const PanelRequest& asked);

/// Leaves the angle with the arrow of gravity at the first of some maps in a row, and at those with another
/// angle, and the scale bar at the last.
void share_row(std::vector<render::FrameView>& maps);

/// Returns the rows of a panel from its maps (at least one row, one for each angle, all of the same length).
/// The last argument is the number of angles next to each other. Text that is common to all titles of a map,
/// and to all captions, appears once above them, with `title` over it. Equal legends, and the scale bar,
/// appear once below. Several maps have letters (a), (b), ... . Maps without furniture remain without it.
std::vector<std::vector<render::FrameView>> panel_rows(std::vector<std::vector<render::FrameView>> maps,
                                                       const std::string& title,
                                                       std::size_t side_by_side = 1);

/// Returns a panel as a sheet, with a row for each angle. If it would be higher than `highest` (px), more
/// angles are placed next to each other, as long as this reduces the height and all texts fit. Throws the
/// errors of lay_out, and Error(usage) if the sheet is higher than largest_side.
render::Sheet panel_sheet(const std::vector<std::vector<render::FrameView>>& maps, const std::string& title,
                          int width, int highest, const render::Font& font);

/// Returns a panel on a sheet of this height (px) as well, in its middle, with as many angles next to each
/// other as make the beds largest. Throws Error(usage) if it does not fit.
render::Sheet panel_sheet_of_size(const std::vector<std::vector<render::FrameView>>& maps,
                                  const std::string& title, int width, int height, const render::Font& font);

}  // namespace talus::pictures
