#include "pictures/panel.h"

#include <algorithm>
#include <fmt/core.h>

#include "base/text.h"
#include "pictures/frame_choice.h"
#include "render/arrange.h"
#include "render/renderer.h"

namespace talus::pictures {
namespace {

/// The beds of a panel, row by row: a title stands where it differs from the one above it, legend and scale
/// below the last.
std::vector<std::vector<render::FrameView>> panel_views(DrawnRun& run, const FrameChoice& choice) {
  std::vector<std::vector<render::FrameView>> rows;
  std::vector<std::string> above(run.series.plan.maps.size());
  for (std::size_t frame : choice) {
    std::vector<render::FrameView>& row = rows.emplace_back();
    for (std::size_t map = 0; map < above.size(); ++map) {
      render::FrameView& view = row.emplace_back(picture(run, frame, map));
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
render::Image draw_rows(std::vector<std::vector<render::FrameView>>& rows, const MapPlan& plan) {
  render::Renderer renderer(render::make_context(plan.context));
  bool coloured = false;
  for (const std::vector<render::FrameView>& row : rows)
    for (const render::FrameView& view : row)
      coloured = coloured || render::pixel_format(view) == render::PixelFormat::colour;
  const std::vector<render::LayoutLimits> limits = level_rows(rows, plan.width, renderer.font());
  std::vector<render::Image> images;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::vector<render::Image> columns;
    for (render::FrameView& view : rows[row]) {
      view.coloured = coloured;
      columns.push_back(renderer.draw(view, plan.width, limits[row]));
    }
    images.push_back(render::beside(columns));
  }
  return render::stacked(images);
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

std::vector<render::LayoutLimits> level_rows(std::vector<std::vector<render::FrameView>>& rows, int width,
                                             const render::Font& font) {
  render::LayoutLimits common;
  common.own_turn = true;
  for (std::vector<render::FrameView>& row : rows)
    for (render::FrameView& view : row) {
      view.letters /= static_cast<double>(row.size());
      common.largest_em = std::min(common.largest_em, render::lay_out(view, width, font).em);
    }
  std::vector<render::LayoutLimits> limits;
  for (const std::vector<render::FrameView>& row : rows)
    limits.push_back(render::level(row, width, font, common));
  return limits;
}

PanelDrawn draw_panel(DrawnRun& run, const std::vector<std::string>& at, const std::string& output,
                      bool overwrite) {
  const FrameChoice choice = frames_at(run.file.frame_tilts(), at, run.theta_c());
  fit_to_frames(run, choice);
  const PictureMarks marks = panel_marks(run, choice, at, output);
  if (is_drawn(output, marks, overwrite)) return {choice.size(), true};
  std::vector<std::vector<render::FrameView>> rows = panel_views(run, choice);
  render::write_png(output, draw_rows(rows, run.series.plan), picture_texts(marks));
  return {choice.size(), false};
}

}  // namespace talus::pictures
