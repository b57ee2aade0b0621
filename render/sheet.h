#pragma once
/// A picture of several views: where each of them stands.

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

/// One view alone. Throws as lay_out does.
Sheet sheet_of(FrameView view, int width, const Font& font, const LayoutLimits& limits = {});

/// The limits of each row of views that share the width of a sheet, whose letters are set to go by that
/// width.
std::vector<LayoutLimits> level_rows(std::vector<std::vector<FrameView>>& rows, int width, const Font& font);

/// Rows of views below each other on a sheet of that width, which the views of a row share equally. The beds
/// and the traces of a row are level, and all letters have one size, which goes by the width of the sheet.
/// Throws as lay_out does.
Sheet sheet_of_rows(std::vector<std::vector<FrameView>> rows, int width, const Font& font);

/// How the views of each of several pictures stand on sheets of one size, as the frames of a movie do.
struct Arrangement {
  int width = 0, height = 0;         ///< px, of the sheets
  int columns = 1;                   ///< of views beside each other
  int cell = 0;                      ///< px: the width of a view
  int left = 0, top = 0;             ///< px: where the first one stands
  std::vector<int> rows;             ///< px: the heights of rows
  std::vector<LayoutLimits> limits;  ///< of each row
};

/// Fits pictures with the same number of views, in as many columns as make the beds largest, into `height`;
/// with 0 all views stand beside each other, and the height follows. Throws as lay_out does, and Error(usage)
/// if they do not fit.
Arrangement arrange(std::vector<std::vector<FrameView>> pictures, int width, int height, const Font& font);
Sheet arranged(std::vector<FrameView> views, const Arrangement& arrangement, const Font& font);

/// Gray, in colour, or in colour on a transparent background, as the views of the sheet ask for.
PixelFormat pixel_format(const Sheet& sheet);
PixelFormat pixel_format(const FrameView& view);

/// Draws a sheet, or a view in a layout of its own.
void paint(Target& target, const Sheet& sheet);
void paint(Target& target, const FrameView& view, const Layout& layout);

}  // namespace talus::render
