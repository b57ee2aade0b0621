#include "pictures/panel.h"

#include <algorithm>
#include <fmt/core.h>

#include "base/text.h"
#include "pictures/frame_choice.h"
#include "render/arrange.h"
#include "render/renderer.h"

namespace talus {
namespace {

/// The beds of a panel, row by row: a title stands where it differs from the one above it, legend and scale
/// below the last.
std::vector<std::vector<FrameView>> panel_views(DrawnRun& run, const FrameChoice& choice) {
  std::vector<std::vector<FrameView>> rows;
  std::vector<std::string> above(run.series.plan.maps.size());
  for (std::size_t frame : choice) {
    std::vector<FrameView>& row = rows.emplace_back();
    for (std::size_t map = 0; map < above.size(); ++map) {
      FrameView& view = row.emplace_back(picture(run, frame, map));
      if (view.title == above[map])
        view.title.clear();
      else
        above[map] = view.title;
      if (frame == choice.back()) continue;
      view.scale_label.clear();
      view.legends.clear();
    }
  }
  return rows;
}

/// All in one pixel format.
Image draw_rows(std::vector<std::vector<FrameView>>& rows, const MapPlan& plan) {
  Renderer renderer(make_context(plan.context));
  bool coloured = false;
  for (const std::vector<FrameView>& row : rows)
    for (const FrameView& view : row) coloured = coloured || pixel_format(view) == PixelFormat::colour;
  const std::vector<LayoutLimits> limits = level_rows(rows, plan.width, renderer.font());
  std::vector<Image> images;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::vector<Image> columns;
    for (FrameView& view : rows[row]) {
      view.coloured = coloured;
      columns.push_back(renderer.draw(view, plan.width, limits[row]));
    }
    images.push_back(beside(columns));
  }
  return stacked(images);
}

PictureMarks panel_marks(const DrawnRun& run, const FrameChoice& choice, const std::vector<std::string>& at,
                         const std::string& output) {
  const PictureSeries& series = run.series;
  PictureKey key;
  key.add("panel", std::to_string(series.plan.maps.size()));
  for (const std::size_t k : choice)
    for (std::size_t map = 0; map < series.plan.maps.size(); ++map)
      key.add("bed", picture_key(series, k, map));
  const std::string angles =
      joined(choice, ", ", [&](std::size_t k) { return tilt_text(series.met.instants[k].tilt); });
  const std::string maps =
      joined(series.plan.maps, " ", [](const MapSettings& map) { return layers_name(map.layers); });
  return {key.text(), picture_request("panel " + joined(at, " "), series, series.asked.maps, output),
          picture_source(series.path, fmt::format("frames at {} deg, {}", angles, maps))};
}

}  // namespace

std::vector<LayoutLimits> level_rows(std::vector<std::vector<FrameView>>& rows, int width, const Font& font) {
  LayoutLimits common;
  common.own_turn = true;
  for (std::vector<FrameView>& row : rows)
    for (FrameView& view : row) {
      view.letters /= static_cast<double>(row.size());
      common.largest_em = std::min(common.largest_em, lay_out(view, width, font).em);
    }
  std::vector<LayoutLimits> limits;
  for (const std::vector<FrameView>& row : rows) limits.push_back(level(row, width, font, common));
  return limits;
}

PanelDrawn draw_panel(DrawnRun& run, const std::vector<std::string>& at, const std::string& output,
                      bool overwrite) {
  const FrameChoice choice = frames_at(run.file.frame_tilts(), at, run.theta_c());
  fit_to_frames(run, choice);
  const PictureMarks marks = panel_marks(run, choice, at, output);
  if (is_drawn(output, marks, overwrite)) return {choice.size(), true};
  std::vector<std::vector<FrameView>> rows = panel_views(run, choice);
  write_png(output, draw_rows(rows, run.series.plan), picture_texts(marks));
  return {choice.size(), false};
}

}  // namespace talus
