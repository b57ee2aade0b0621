#include "pictures/picture_files.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <optional>
#include <utility>

#include "base/errors.h"
#include "base/output_file.h"
#include "base/version.h"
#include "core/trigonometry.h"
#include "pictures/background_tasks.h"
#include "pictures/scale.h"
#include "render/document.h"
#include "render/png.h"
#include "render/renderer.h"

namespace talus::pictures {
namespace {

/// Largest number of pictures that wait to be written; one of 16 megapixels in colour takes 48 MB.
constexpr std::size_t pictures_waiting = 2;

/// Returns "gamma_012.00.png" for frame k of the tilt, and "gamma_flow_002.3500s.png" for one of the flow
/// after failure, with the time since the last frame of the tilt. A run that goes by time, and may reach an
/// angle several times, has "gamma_00042_012.00.png", with the number of the frame. Names sort by time.
std::string picture_name(const PictureSeries& series, std::size_t k, std::size_t map, int decimals,
                         const std::string& ending) {
  const FrameInstant &instant = series.seen_frames.instants[k],
                     &highest = series.seen_frames.instants[series.seen_frames.highest];
  const std::string name = name_of(series.plan.maps[map]);
  if (series.goes_by_time) return fmt::format("{}_{:05}_{}.{}", name, k, angle_name(instant.tilt, 2), ending);
  if (k <= series.seen_frames.highest)
    return fmt::format("{}_{}.{}", name, angle_name(instant.tilt, decimals), ending);
  return fmt::format("{}_flow_{:08.4f}s.{}", name, instant.time - highest.time, ending);
}

}  // namespace

PictureFile picture_file(const PictureSeries& series, const std::string& folder, std::size_t k,
                         std::size_t map, int decimals, const std::string& ending) {
  const std::string name = picture_name(series, k, map, decimals, ending);
  return {k, map, (std::filesystem::path(folder) / name).string(), picture_source(series, k, map)};
}

std::vector<PictureFile> picture_files(DrawnRun& run, const FrameChoice& choice, const std::string& folder,
                                       const std::string& ending) {
  fit_to_frames(run, choice);
  const PictureSeries& series = run.series;
  const int decimals = series.goes_by_time ? 2 : angle_decimals(run.file.frame_tilts(), choice);
  std::vector<PictureFile> files;
  for (const std::size_t k : choice)
    for (std::size_t map = 0; map < series.plan.maps.size(); ++map)
      files.push_back(picture_file(series, folder, k, map, decimals, ending));
  return files;
}

render::Sheet sheet_of_plan(render::FrameView view, const MapPlan& plan, const render::Font& font) {
  if (plan.height == 0) return render::sheet_of(std::move(view), plan.width, font);
  const render::Arrangement arrangement =
      render::arrange({std::vector<render::FrameView>{view}}, plan.width, plan.height, font);
  return render::arranged({std::move(view)}, arrangement, font);
}

void write_sheet(const std::string& path, const render::Sheet& sheet, const MapPlan& plan,
                 const render::PictureTexts& texts) {
  if (render::is_document(path)) return render::write_document(path, sheet, plan.page_width(), texts);
  render::Renderer renderer(render::make_context(plan.context));
  render::write_png(path, renderer.draw(sheet), texts, plan.page_width());
}

void draw_files(DrawnRun& run, const std::vector<PictureFile>& files, const std::string& folder,
                const Watch& watch) {
  const MapPlan& plan = run.series.plan;
  const render::Font font = render::embedded_font();
  std::optional<render::Renderer> renderer;
  BackgroundTasks writer(pictures_waiting);  // encodes and writes one picture while the next is drawn
  for (std::size_t done = 0; done < files.size(); ++done) {
    const PictureFile& file = files[done];
    if (watch.stopped()) {
      writer.finish();
      throw Error(ExitCode::stopped,
                  "stopped after {} of {} pictures, which are complete; to draw all, repeat the command with "
                  "--overwrite",
                  done, files.size());
    }
    render::Sheet sheet = sheet_of_plan(picture(run, file.frame, file.map), plan, font);
    if (!renderer && !render::is_document(file.path)) renderer.emplace(render::make_context(plan.context));
    if (done == 0) prepare_folder(folder);
    if (render::is_document(file.path)) {
      writer.post([&file, &plan, sheet = std::move(sheet)] {
        write_sheet(file.path, sheet, plan, picture_texts(file.source));
      });
    } else {
      writer.post([&file, &plan, image = renderer->draw(sheet)] {
        render::write_png(file.path, image, picture_texts(file.source), plan.page_width());
      });
    }
    if (watch.progress) watch.progress(done + 1, files.size());
  }
  writer.finish();
}

std::string picture_source(const PictureSeries& series, std::size_t k, std::size_t map) {
  return picture_source(series.path,
                        fmt::format("frame at {} deg, {}", tilt_text(series.seen_frames.instants[k].tilt),
                                    name_of(series.plan.maps[map])));
}

std::string picture_source(const std::string& run, const std::string& shown) {
  std::string source = fmt::format("{}, {}", std::filesystem::path(run).filename().string(), shown);
  for (char& c : source)  // texts of pictures are ASCII, and those of documents end at these characters
    if (c < ' ' || c > '~' || c == ';' || c == '<' || c == '(' || c == ')' || c == '\\') c = '?';
  return source;
}

std::string tilt_text(double tilt) { return fmt::format("{:.3f}", degrees(tilt)); }

render::PictureTexts picture_texts(const std::string& source) {
  return {{"Software", version_text()}, {"Source", source}};
}

}  // namespace talus::pictures
