#include "pictures/picture_marks.h"

#include <filesystem>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/output_file.h"
#include "base/paths.h"
#include "base/version.h"
#include "core/trigonometry.h"
#include "pictures/texts.h"
#include "render/document.h"

namespace talus::pictures {
namespace {

constexpr const char* key_word = "talus:key";
constexpr const char* request_word = "talus:request";

/// Returns the path of the run file relative to the folder of the picture, because both may move together. A
/// run under way has its final name.
std::string relative_run_path(const std::filesystem::path& picture, std::filesystem::path run) {
  namespace fs = std::filesystem;
  if (!run.has_filename()) run = run.parent_path();  // RUN.h5.run/
  if (run.extension() == ".run") run.replace_extension();
  const fs::path folder = resolved_path(fs::path(absolute_path(picture.string())).parent_path().string());
  return fs::path(resolved_path(run.string())).lexically_relative(folder).string();
}

}  // namespace

void PictureKey::add(const std::string& name, const std::string& value) {
  hasher_.add_array(name);
  hasher_.add_array(value);
}

void PictureKey::add(const std::string& name, double value) {
  hasher_.add_array(name);
  hasher_.add(value);
}

void PictureKey::add(const std::string& name, const std::vector<double>& values) {
  hasher_.add_array(name);
  hasher_.add_array(values);
}

std::string PictureKey::text() const { return hash_text(hasher_.value()); }

namespace {

/// Adds the identity of the run: its scenario, seed, start time and version; and the version that draws.
void add_run(PictureKey& key, const io::RunHeader& header) {
  key.add("talus", version_text());
  key.add("scenario", header.scenario_resolved);
  key.add("seed", std::to_string(header.seed));
  for (const auto& [name, value] : header.provenance)
    if (name == "start" || name == "version" || name == "git_hash") key.add(name, value);
}

void add_settings(PictureKey& key, const MapSettings& settings, int width, const MapExtent& extent) {
  key.add("layers", layers_name(settings.layers));
  key.add("colours", settings.colours ? std::string(render::colour_map_name(*settings.colours)) : "");
  if (settings.palette != ClusterPalette::muted)
    key.add("palette", std::string(palette_name(settings.palette)));
  key.add("range_low", settings.range_low ? std::vector{*settings.range_low} : std::vector<double>{});
  key.add("range_high", settings.range_high ? std::vector{*settings.range_high} : std::vector<double>{});
  for (const auto& [kind, ranges] : settings.motion.fitting)
    for (const std::optional<ScaleRange>& range : ranges)
      key.add("motion", range ? std::vector{range->low, range->high} : std::vector<double>{});
  key.add("theta_c", settings.theta_c);
  key.add("theta_c_assumed", settings.theta_c_assumed);
  key.add("threshold_factor", settings.threshold_factor);
  key.add("l_min", settings.l_min);
  key.add("length", settings.length);
  key.add("joined_by_neighbours", settings.joined_by_neighbours);
  key.add("turned", settings.turned);
  key.add("tilt_max", settings.tilt_max);
  key.add("furniture", settings.furniture);
  key.add("transparent", settings.transparent);
  key.add("printed", settings.printed);
  key.add("points", settings.points);
  key.add("width", width);
  key.add("extent", std::vector{extent.x_min, extent.x_max, extent.y_min, extent.y_max});
}

}  // namespace

std::string picture_key(const PictureSeries& series, std::size_t k, std::size_t map) {
  PictureKey key;
  add_run(key, series.run);
  add_settings(key, series.plan.maps[map], series.plan.width, series.extent);
  key.add("step", std::to_string(series.seen_frames.instants[k].step));
  key.add("tilt", series.seen_frames.instants[k].tilt);
  if (any_layer(series.plan, needs_reference))
    key.add("since",
            series.since ? std::to_string(series.seen_frames.instants[*series.since].step) : "frame before");
  for (std::size_t t = 0; t < series.curves.size(); ++t) {
    key.add("trace", std::string(trace_name(series.plan.traces[t])));
    key.add("tilts", series.curves[t].places);
    key.add("values", series.curves[t].values);
  }
  return key.text();
}

std::string picture_request(const std::string& command, const PictureSeries& series,
                            std::span<const MapSettings> maps, const std::string& picture) {
  const MapPlan& plan = series.asked;
  PictureKey request;
  request.add("command", command);
  request.add("run", relative_run_path(picture, series.path));
  for (const MapSettings& map : maps) add_settings(request, map, plan.width, {});
  for (const TraceKind trace : plan.traces) request.add("trace", std::string(trace_name(trace)));
  if (plan.crop) request.add("crop", std::vector{plan.crop->x0, plan.crop->y0, plan.crop->x1, plan.crop->y1});
  if (plan.since) request.add("since", *plan.since);
  return request.text();
}

std::string picture_source(const PictureSeries& series, std::size_t k, std::size_t map) {
  return picture_source(series.path,
                        fmt::format("frame at {} deg, {}", tilt_text(series.seen_frames.instants[k].tilt),
                                    layers_name(series.plan.maps[map].layers)));
}

std::string picture_source(const std::string& run, const std::string& shown) {
  std::string source = fmt::format("{}, {}", std::filesystem::path(run).filename().string(), shown);
  for (char& c : source)  // texts of pictures are ASCII, and those of documents end at these characters
    if (c < ' ' || c > '~' || c == ';' || c == '<' || c == '(' || c == ')' || c == '\\') c = '?';
  return source;
}

std::string tilt_text(double tilt) { return fmt::format("{:.3f}", degrees(tilt)); }

render::PictureTexts picture_texts(const PictureMarks& marks) {
  return {{"Software", version_text()},
          {"Source", marks.source},
          {key_word, marks.key},
          {request_word, marks.request}};
}

bool is_drawn(const std::string& path, const PictureMarks& marks, bool overwrite) {
  output_target(path);
  if (!is_there(path)) return false;
  const auto text_of = render::is_document(path) ? render::document_text : render::png_text;
  if (text_of(path, key_word) == marks.key) return true;
  if (overwrite || text_of(path, request_word) == marks.request) return false;
  throw Error(
      ExitCode::cannot_create,
      path +
          " exists and is not the requested picture (it is of another run file, with other "
          "options, or not drawn by Talus); give --overwrite to replace it, or choose another output");
}

}  // namespace talus::pictures
