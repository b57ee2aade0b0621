#pragma once
/// A picture of several views and their positions.

#include <vector>

#include "render/layout.h"
#include "render/target.h"

namespace talus::render {

/// A view and its layout, in px of the sheet.
struct PlacedView {
  FrameView view;
  Layout layout;
};

struct Sheet {
  int width = 0, height = 0;  ///< px
  std::vector<PlacedView> views;
};

/// Returns a sheet with one view. Throws the errors of lay_out.
Sheet sheet_of(FrameView view, int width, const Font& font, const LayoutLimits& limits = {});

/// Returns the limits of each row of views that share the width of a sheet, and rescales the font sizes of
/// the views to that width.
std::vector<LayoutLimits> level_rows(std::vector<std::vector<FrameView>>& rows, int width, const Font& font);

/// Returns a sheet of that width with rows of views below each other. The views of a row share the width
/// equally, and their beds and traces are aligned. All font sizes are equal and refer to the width of the
/// sheet. Throws the errors of lay_out.
Sheet sheet_of_rows(std::vector<std::vector<FrameView>> rows, int width, const Font& font);

/// The arrangement of views on sheets of one size, such as the frames of a movie.
struct Arrangement {
  int width = 0, height = 0;         ///< size of the sheets, px
  int columns = 1;                   ///< number of views next to each other
  int cell = 0;                      ///< width of a view, px
  int left = 0, top = 0;             ///< position of the first view, px
  std::vector<int> rows;             ///< heights of the rows, px
  std::vector<LayoutLimits> limits;  ///< one for each row
  double trace_height = 0.0;         ///< height of curves in a row of their own, in font sizes
};

/// Fits pictures with the same number of views into `height`, in the number of columns that makes the beds
/// largest. With height 0, all views are next to each other, and the height follows. Throws the errors of
/// lay_out, and Error(usage) if the views do not fit.
Arrangement arrange(std::vector<std::vector<FrameView>> pictures, int width, int height, const Font& font);
Sheet arranged(std::vector<FrameView> views, const Arrangement& arrangement, const Font& font);

/// Returns the format that the views require: gray, colour, or colour on a transparent background.
PixelFormat pixel_format(const Sheet& sheet);
PixelFormat pixel_format(const FrameView& view);

/// Draws a sheet, or a view in a given layout.
void paint(Target& target, const Sheet& sheet);
void paint(Target& target, const FrameView& view, const Layout& layout);

}  // namespace talus::render
