#include "pictures/picture_series.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <iterator>
#include <utility>

#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "pictures/frame_choice.h"
#include "pictures/layers.h"
#include "pictures/scale.h"

namespace talus::pictures {
namespace {

/// Returns "0.50,1.25": a position in the bed (m) in mean diameters.
std::string place_text(double x, double y, double diameter) {
  return fmt::format("{:.2f},{:.2f}", x / diameter, y / diameter);
}

/// Returns the frame of --since; none if motion is measured from the preceding frame.
std::optional<std::size_t> reference_since(const std::vector<double>& tilts, std::optional<double> since) {
  if (!since) return std::nullopt;
  const auto [lowest, highest] = std::ranges::minmax(tilts);
  const double spacing =
      tilts.size() > 1 ? (highest - lowest) / static_cast<double>(tilts.size() - 1) : radians(1.0);
  if (*since > highest + 0.5 * spacing)
    throw Error(ExitCode::bad_data, "--since {:.6g}: the frames of the run end at {} deg", degrees(*since),
                degrees_text(highest, 2));
  const std::optional<std::size_t> first = frame_near(tilts, *since);  // the first time at that tilt
  return first ? first : nearest_frame(tilts, *since);
}

/// Returns the position of a frame or row on the axis of a trace, once the first frame was added.
double place_of(const PictureSeries& series, double tilt, double time) {
  return series.goes_by_time ? time - series.seen_frames.instants.front().time : tilt;
}

void add_frames(PictureSeries& series, const io::RunFile& file, const CountDone& progress) {
  const MapPlan& plan = series.plan;
  const bool whole = shows(plan, MapKind::clusters) || std::ranges::any_of(plan.traces, trace_from_frames);
  const std::size_t count = file.all_frame_tilts().size();
  for (std::size_t k = 0; k < count; ++k) {
    const Frame frame = whole ? as_mapped(series, file.frame(k)) : file.positions(k);
    const BedFrame bed{frame, series.run.statics};
    add_frame(series, frame);
    extend(series.extent, bed);
    for (std::size_t t = 0; t < plan.traces.size() && k < file.frame_count(); ++t)
      if (trace_from_frames(plan.traces[t])) {
        series.curves[t].places.push_back(place_of(series, frame.tilt, frame.time));
        series.curves[t].values.push_back(frame_value(plan.traces[t], bed, plan.maps[0]));
      }
    if (progress) progress(k + 1, count);
  }
  series.seen_frames.highest = file.frame_count() - 1;
}

void take_observables(PictureSeries& series, const io::RunFile& file) {
  if (std::ranges::all_of(series.plan.traces, trace_from_frames)) return;
  const std::vector<ObservableRow> rows = file.observables();
  for (std::size_t t = 0; t < series.plan.traces.size(); ++t) {
    if (trace_from_frames(series.plan.traces[t])) continue;
    for (const ObservableRow& row : rows) {
      series.curves[t].places.push_back(
          place_of(series, at(row, Observable::tilt), at(row, Observable::time)));
      series.curves[t].values.push_back(at(row, trace_column(series.plan.traces[t])));
    }
  }
}

MapExtent cropped(const MapExtent& bed, const MapExtent& crop, double diameter) {
  const MapExtent asked{crop.x_min * diameter, crop.x_max * diameter, crop.y_min * diameter,
                        crop.y_max * diameter};
  if (asked.x_min < bed.x_min || asked.x_max > bed.x_max || asked.y_min < bed.y_min ||
      asked.y_max > bed.y_max)
    throw Error(
        ExitCode::usage,
        "--crop {:.6g},{:.6g},{:.6g},{:.6g} leaves the bed, which extends from {} to {} mean diameters",
        crop.x_min, crop.y_min, crop.x_max, crop.y_max, place_text(bed.x_min, bed.y_min, diameter),
        place_text(bed.x_max, bed.y_max, diameter));
  return asked;
}

/// Adds an instant. The last frame of the tilt is not known yet; without a flow it is the last one, which in
/// a run that goes by time makes no difference.
void add_instant(PictureSeries& series, const Frame& frame) {
  SeenFrames& seen_frames = series.seen_frames;
  if (seen_frames.instants.empty() || series.goes_by_time ||
      frame.tilt > seen_frames.instants[seen_frames.highest].tilt)
    seen_frames.highest = seen_frames.instants.size();
  if (seen_frames.instants.empty())
    for (std::size_t i = 0; i < frame.x.size(); ++i) seen_frames.begin.push_back({frame.x[i], frame.y[i]});
  seen_frames.instants.push_back({frame.step, frame.time, frame.tilt});
}

void read_frame(DrawnRun& run, std::size_t k) {
  if (run.current == k) return;
  const std::optional<std::size_t> wanted = reference_of(run.series, k);
  if (wanted && wanted != run.before)
    run.reference = run.current == wanted ? std::move(run.frame) : run.file.frame(*wanted);
  run.before = wanted;
  run.frame = as_mapped(run.series, run.file.frame(k));
  run.current = k;
}

const Frame* reference_of(const DrawnRun& run) { return run.before ? &run.reference : nullptr; }

}  // namespace

void settle_theta_c(MapPlan& plan, double theta_c) {
  const double scale = std::isnan(theta_c) && needs_theta_c(plan) ? radians(assumed_theta_c) : theta_c;
  for (MapSettings& map : plan.maps) {
    if (std::isnan(map.theta_c)) map.theta_c = scale;
    map.theta_c_assumed = !std::isnan(map.theta_c) && map.theta_c != theta_c;
  }
}

Frame as_mapped(const PictureSeries& series, Frame frame) {
  if (!shows_gamma(series.plan)) return frame;
  return mapped_frame(std::move(frame), series.run.statics, series.plan.maps[0].l_min);
}

void add_frame(PictureSeries& series, const Frame& mapped) {
  if (shows(series.plan, MapKind::clusters))
    add_frame(series, mapped, overloaded_clusters({mapped, series.run.statics}, series.plan.maps[0]));
  else
    add_instant(series, mapped);
}

void add_frame(PictureSeries& series, const Frame& mapped, const analysis::Clusters& clusters) {
  add_instant(series, mapped);
  series.seen_frames.rule = series.plan.maps[0];
  series.seen_frames.cluster_colours.push_back(series.seen_frames.tracker.next(clusters));
}

std::optional<std::size_t> reference_of(const PictureSeries& series, std::size_t k) {
  return any_layer(series.plan, needs_reference) ? reference_frame(k, series.since) : std::nullopt;
}

render::FrameView picture(const PictureSeries& series, std::size_t k, const Frame& frame,
                          const Frame* reference, std::size_t map) {
  const MapSettings& settings = series.plan.maps[map];
  const analysis::GrainSource source{{frame, series.run.statics}, reference, !series.since, k};
  render::FrameView view = make_map(source, settings, series.extent, &series.seen_frames);
  for (std::size_t t = 0; t < series.curves.size(); ++t)
    view.traces.push_back(make_trace(series.plan.traces[t], series.curves[t].places, series.curves[t].values,
                                     settings, place_of(series, frame.tilt, frame.time),
                                     series.goes_by_time ? TraceAxis::time : TraceAxis::tilt));
  return view;
}

DrawnRun open_drawn_run(const std::string& path, const MapPlan& plan, const CountDone& progress) {
  DrawnRun run{io::RunFile::open(path), {}, {}, {}, {}, {}};
  PictureSeries& series = run.series;
  series.path = path;
  series.plan = plan;
  series.run = run.file.header();
  series.goes_by_time = run.file.goes_by_time();
  if (run.file.frame_count() == 0)
    throw Error(ExitCode::bad_data, path + " has no frames yet: nothing is drawn before the tilt begins");
  settle_theta_c(series.plan, run.theta_c());
  series.since = reference_since(run.file.frame_tilts(), plan.since);
  series.curves.resize(plan.traces.size());
  series.extent = bed_extent(series.run.statics);
  add_frames(series, run.file, progress);
  take_observables(series, run.file);
  if (plan.crop) series.extent = cropped(series.extent, *plan.crop, series.run.statics.mean_diameter);
  for (MapSettings& map : series.plan.maps)
    if (map.turned) map.tilt_max = std::ranges::max(run.file.all_frame_tilts());
  return run;
}

void fit_to_frames(DrawnRun& run, std::span<const std::size_t> frames) {
  PictureSeries& series = run.series;
  double steepest = 0.0;
  for (const std::size_t k : frames) steepest = std::max(steepest, series.seen_frames.instants[k].tilt);
  for (MapSettings& map : series.plan.maps)
    if (map.turned) map.tilt_max = steepest;
  if (!any_layer(series.plan, fits_frames)) return;
  MapLayers moving;
  for (const MapSettings& map : series.plan.maps)
    std::ranges::copy_if(map.layers, std::back_inserter(moving), fits_frames);
  MotionSample sample(moving, series.plan.maps[0]);
  for (const std::size_t k : frames) {
    read_frame(run, k);
    sample.add({{run.frame, series.run.statics}, reference_of(run), !series.since});
  }
  for (MapSettings& map : series.plan.maps) map.motion = sample.ranges();
}

render::FrameView picture(DrawnRun& run, std::size_t k, std::size_t map) {
  read_frame(run, k);
  return picture(run.series, k, run.frame, reference_of(run), map);
}

}  // namespace talus::pictures
