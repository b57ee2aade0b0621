#include "render/sheet.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <optional>
#include <utility>

#include "base/errors.h"
#include "render/furniture.h"

namespace talus::render {
namespace {

bool is_gray(const Legend& legend) {
  const auto gray_bar = [](const Bar& bar) {
    return std::ranges::all_of(bar.colours, [](const Colour& colour) { return is_gray(colour); });
  };
  return std::ranges::all_of(legend.bars, gray_bar) &&
         std::ranges::all_of(legend.swatches, [](const Swatch& swatch) {
           return is_gray(swatch.fill) && is_gray(swatch.rim);
         });
}

/// Returns a window with pixel coordinates for furniture, which has y upwards from the top of the picture.
Window whole_picture(int width, int height) {
  Window window;
  window.box = {0.0, 0.0, static_cast<double>(width), static_cast<double>(height)};
  window.x_max = width;
  window.y_min = -height;
  return window;
}

void paint_view(Target& target, const FrameView& view, const Layout& layout, const Window& picture) {
  target.draw_discs(view.discs, layout.bed);
  target.draw_lines(view.lines, layout.bed);
  if (!view.furniture) return;
  const Furniture furniture = furnish(view, layout);
  target.draw_areas(furniture.areas);
  target.draw_texts(furniture.texts, layout.em);
  target.draw_lines(furniture.lines, picture);
  target.draw_discs(furniture.discs, picture);
}

}  // namespace

Sheet sheet_of(FrameView view, int width, const Font& font, const LayoutLimits& limits) {
  Layout layout = lay_out(view, width, font, limits);
  Sheet sheet{layout.width, layout.height, {}};
  sheet.views.push_back({std::move(view), std::move(layout)});
  return sheet;
}

std::vector<LayoutLimits> level_rows(std::vector<std::vector<FrameView>>& rows, int width, const Font& font) {
  LayoutLimits common;
  common.own_turn = true;
  for (std::vector<FrameView>& row : rows)
    for (FrameView& view : row) {
      if (!view.furniture) continue;
      view.letters /= static_cast<double>(row.size());
      view.max_letters /= static_cast<double>(row.size());
      const int own = width / static_cast<int>(row.size());
      common.largest_em = std::min(common.largest_em, lay_out(view, own, font).em);
    }
  std::vector<LayoutLimits> limits;
  for (const std::vector<FrameView>& row : rows)
    limits.push_back(level(row, width / static_cast<int>(row.size()), font, common));
  return limits;
}

Sheet sheet_of_rows(std::vector<std::vector<FrameView>> rows, int width, const Font& font) {
  const std::vector<LayoutLimits> limits = level_rows(rows, width, font);
  Sheet sheet{width, 0, {}};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const int own = width / static_cast<int>(rows[r].size());
    const std::size_t first = sheet.views.size();
    const bool turned = rows[r].front().turn > 0.0;
    double height = 0.0, left = 0.0, room = turned ? sheet.height : 0.0;
    for (FrameView& view : rows[r]) {
      Layout layout = lay_out(view, own, font, limits[r]);
      height = std::max<double>(height, layout.height);
      move_by(layout, left, sheet.height);
      left += own;
      for (std::size_t above = 0; turned && above < first; ++above)
        room = std::min(room, room_between(sheet.views[above].layout, layout, width) - layout.em);
      sheet.views.push_back({std::move(view), std::move(layout)});
    }
    // A row of turned beds moves up along the slope of those above.
    const int up = static_cast<int>(std::max(0.0, room));
    for (std::size_t k = first; k < sheet.views.size(); ++k) move_by(sheet.views[k].layout, 0.0, -up);
    sheet.height += static_cast<int>(height) - up;
  }
  return sheet;
}

namespace {

/// Returns the width of view k; a view with curves alone that begins a row takes the full row.
int width_of(const FrameView& view, std::size_t k, const Arrangement& arrangement) {
  const bool alone = view.x_max <= view.x_min && k % static_cast<std::size_t>(arrangement.columns) == 0;
  return arrangement.cell * (alone ? arrangement.columns : 1);
}

/// Adapts views to their cells: font sizes refer to the width of the sheet, and curves alone are as high as a
/// bed next to them or, in a row of their own, as the arrangement says.
void fit_to_cells(std::vector<FrameView>& views, const Arrangement& arrangement) {
  double height = 0.0;  // height of the bed, in font sizes
  for (std::size_t k = 0; k < views.size(); ++k) {
    FrameView& view = views[k];
    const double share = static_cast<double>(width_of(view, k, arrangement)) / arrangement.width;
    view.letters *= share;
    view.max_letters *= share;
    if (view.x_max > view.x_min)
      height = std::max(height, view.letters * (view.y_max - view.y_min) / (view.x_max - view.x_min));
  }
  for (std::size_t k = 0; k < views.size(); ++k) {
    FrameView& view = views[k];
    if (view.x_max > view.x_min || view.traces.empty()) continue;
    const double largest = std::floor(height / static_cast<double>(view.traces.size()));
    const bool own_row = k % static_cast<std::size_t>(arrangement.columns) == 0;
    view.trace_height =
        std::max(view.trace_height, own_row ? std::min(arrangement.trace_height, largest) : largest);
  }
}

Arrangement arrange_with(std::vector<std::vector<FrameView>> pictures, int width, int columns, int cell,
                         const Font& font, double trace_height = 0.0) {
  Arrangement found{width, 0, columns, cell, 0, 0, {}, {}, trace_height};
  LayoutLimits common;
  const std::size_t count = pictures.front().size();
  for (std::vector<FrameView>& views : pictures) {
    fit_to_cells(views, found);
    for (std::size_t k = 0; k < count; ++k)
      common.largest_em =
          std::min(common.largest_em, lay_out(views[k], width_of(views[k], k, found), font).em);
  }
  for (std::size_t first = 0; first < count; first += static_cast<std::size_t>(columns)) {
    std::vector<FrameView> row;
    for (const std::vector<FrameView>& views : pictures)
      for (std::size_t k = first; k < std::min(count, first + static_cast<std::size_t>(columns)); ++k)
        row.push_back(views[k]);
    const int own = width_of(row.front(), first, found);
    found.limits.push_back(level(row, own, font, common));
    int height = 0;
    for (const FrameView& view : row)
      height = std::max(height, lay_out(view, own, font, found.limits.back()).height);
    found.rows.push_back(height);
    found.height += height;
  }
  return found;
}

/// Returns a sample of the pictures, to estimate their sizes.
std::vector<std::vector<FrameView>> sample_of(const std::vector<std::vector<FrameView>>& pictures) {
  constexpr std::size_t most = 8;
  const std::size_t step = (pictures.size() + most - 1) / most;
  std::vector<std::vector<FrameView>> sample = {pictures.back()};
  for (std::size_t k = 0; k < pictures.size(); k += step) sample.push_back(pictures[k]);
  return sample;
}

/// Returns the arrangement with the largest cells, wider than `least`, that fits this number of columns, or
/// nothing if none fits. Narrower cells may need more height because their texts break into more lines.
std::optional<Arrangement> largest_fit(const std::vector<std::vector<FrameView>>& pictures, int width,
                                       int height, int columns, int least, const Font& font) {
  const auto fit = [&](const std::vector<std::vector<FrameView>>& rows,
                       int cell) -> std::optional<Arrangement> {
    try {
      Arrangement found = arrange_with(rows, width, columns, cell, font);
      if (found.height <= height) return found;
    } catch (const Error&) {  // no legible layout
    }
    return std::nullopt;
  };
  const std::vector<std::vector<FrameView>> sample = sample_of(pictures);
  for (int cell = width / columns; cell > least; cell -= std::max(1, width / 100))
    if (fit(sample, cell))
      if (std::optional<Arrangement> found = fit(pictures, cell)) return found;
  return std::nullopt;
}

}  // namespace

Arrangement arrange(std::vector<std::vector<FrameView>> pictures, int width, int height, const Font& font) {
  const int count = static_cast<int>(pictures.front().size());
  if (height == 0) return arrange_with(std::move(pictures), width, count, width / count, font);
  std::optional<Arrangement> best;
  for (int columns = 1; columns <= count; ++columns)
    if (auto found =
            largest_fit(pictures, width, height, columns, best ? best->cell : smallest_width - 1, font))
      best = std::move(found);
  if (!best)
    throw Error(ExitCode::usage,
                "the maps with their texts do not fit into {} x {} px; use a larger size, or fewer maps",
                width, height);
  // Curves below the beds take the room that is left.
  const std::vector<FrameView>& views = pictures.front();
  const double curves = static_cast<double>(views.back().traces.size()) * best->limits.back().largest_em;
  if (curves > 0.0 && views.back().x_max <= views.back().x_min) {
    const double higher = views.back().trace_height + std::floor((height - best->height) / curves);
    const Arrangement filled = arrange_with(pictures, width, best->columns, best->cell, font, higher);
    if (filled.height <= height) best = filled;
  }
  best->left = (width - best->columns * best->cell) / 2;
  best->top = (height - best->height) / 2;
  best->height = height;
  return *best;
}

Sheet arranged(std::vector<FrameView> views, const Arrangement& arrangement, const Font& font) {
  fit_to_cells(views, arrangement);
  Sheet sheet{arrangement.width, arrangement.height, {}};
  const auto columns = static_cast<std::size_t>(arrangement.columns);
  int top = arrangement.top;
  for (std::size_t k = 0; k < views.size(); ++k) {
    const std::size_t row = k / columns;
    Layout layout = lay_out(views[k], width_of(views[k], k, arrangement), font, arrangement.limits[row]);
    move_by(layout, arrangement.left + static_cast<int>(k % columns) * arrangement.cell, top);
    sheet.views.push_back({std::move(views[k]), std::move(layout)});
    if (k % columns + 1 == columns) top += arrangement.rows[row];
  }
  return sheet;
}

PixelFormat pixel_format(const FrameView& view) {
  if (view.transparent) return PixelFormat::transparent;
  const bool gray = !view.coloured && std::ranges::all_of(view.discs, [](const Disc& disc) {
    return is_gray(disc.fill) && is_gray(disc.rim);
  }) && std::ranges::all_of(view.lines, [](const Line& line) {
    return is_gray(line.colour);
  }) && std::ranges::all_of(view.legends, [](const Legend& legend) { return is_gray(legend); });
  return gray ? PixelFormat::gray : PixelFormat::colour;
}

PixelFormat pixel_format(const Sheet& sheet) {
  PixelFormat format = PixelFormat::gray;
  for (const PlacedView& placed : sheet.views) format = std::max(format, pixel_format(placed.view));
  return format;
}

void paint(Target& target, const Sheet& sheet) {
  target.begin(sheet.width, sheet.height, pixel_format(sheet));
  for (const PlacedView& placed : sheet.views)
    paint_view(target, placed.view, placed.layout, whole_picture(sheet.width, sheet.height));
}

void paint(Target& target, const FrameView& view, const Layout& layout) {
  target.begin(layout.width, layout.height, pixel_format(view));
  paint_view(target, view, layout, whole_picture(layout.width, layout.height));
}

}  // namespace talus::render
