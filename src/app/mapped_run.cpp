#include "app/mapped_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "app/count_progress.h"
#include "app/picture_key.h"
#include "core/errors.h"
#include "core/trigonometry.h"
#include "maps/cluster_frame.h"
#include "maps/motion.h"

namespace talus {
namespace {

std::string formatted(const char* pattern, double a, double b = 0.0, double c = 0.0, double d = 0.0) {
  char text[128];
  std::snprintf(text, sizeof text, pattern, a, b, c, d);
  return text;
}

}  // namespace

MappedRun::MappedRun(const std::string& path, const MapPlan& plan,
                     const std::function<void(std::size_t, std::size_t)>& progress)
    : path_(path),
      file_(RunFile::open(path)),
      asked_(plan),
      plan_(plan),
      extent_(bed_extent(file_.header().statics)) {
  if (file_.frame_count() == 0)
    throw Error(ExitCode::bad_data, path + " has no frames yet: nothing is drawn before the tilt begins");
  take_theta_c();
  take_reference();
  series_.resize(plan_.traces.size());
  meet_frames(progress);
  read_observables();
  take_crop();
  for (MapSettings& map : plan_.maps)
    if (map.turned) map.tilt_max = std::ranges::max(file_.all_frame_tilts());
}

void MappedRun::take_theta_c() {
  const std::optional<double> measured = find_value(file_.checkpoint().results, "theta_c");
  if (!std::isfinite(theta_c()) && measured)
    for (MapSettings& map : plan_.maps) map.theta_c = *measured;
  if (std::isfinite(theta_c()) || !needs_theta_c(plan_)) return;
  throw Error(ExitCode::bad_data, path_ +
                                      ": the slope has not failed in this run, and what is asked for is "
                                      "scaled by the angle of repose; give it with --theta-c DEG");
}

void MappedRun::take_reference() {
  if (!plan_.since) return;
  const std::vector<double>& tilts = file_.frame_tilts();
  const auto nearest =
      std::ranges::min_element(tilts, {}, [this](double tilt) { return std::abs(tilt - *plan_.since); });
  since_ = static_cast<std::size_t>(nearest - tilts.begin());
  const bool last = *since_ + 1 == tilts.size();
  const double spacing = tilts.size() > 1
                             ? (tilts.back() - tilts.front()) / static_cast<double>(tilts.size() - 1)
                             : radians(1.0);
  if (last && *plan_.since > tilts.back() + 0.5 * spacing)
    throw Error(ExitCode::bad_data, formatted("--since %g: the frames of the run end at %.2f deg",
                                              degrees(*plan_.since), degrees(tilts.back())));
}

void MappedRun::meet_frames(const std::function<void(std::size_t, std::size_t)>& progress) {
  const RunStatics& statics = file_.header().statics;
  const bool clusters = draws_clusters(plan_);
  const bool whole = clusters || std::ranges::any_of(plan_.traces, trace_from_frames);
  const std::size_t count = file_.all_frame_tilts().size();
  ClusterColours colours;
  for (std::size_t k = 0; k < count; ++k) {
    const Frame frame = whole ? as_mapped(file_.frame(k)) : file_.positions(k);
    instants_.push_back({frame.step, frame.time, frame.tilt});
    extend(extent_, frame, statics);
    if (clusters)
      cluster_colours_.push_back(colours.next(overloaded_clusters(frame, statics, plan_.maps[0])));
    for (std::size_t t = 0; t < plan_.traces.size() && k < file_.frame_count(); ++t)
      if (trace_from_frames(plan_.traces[t])) {
        series_[t].tilts.push_back(frame.tilt);
        series_[t].values.push_back(frame_value(plan_.traces[t], frame, statics, plan_.maps[0]));
      }
    if (progress) progress(k + 1, count);
  }
}

void MappedRun::read_observables() {
  if (std::ranges::all_of(plan_.traces, trace_from_frames)) return;
  const std::vector<ObservableRow> rows = file_.observables();
  for (std::size_t t = 0; t < plan_.traces.size(); ++t) {
    if (trace_from_frames(plan_.traces[t])) continue;
    for (const ObservableRow& row : rows) {
      series_[t].tilts.push_back(at(row, Observable::tilt));
      series_[t].values.push_back(at(row, trace_column(plan_.traces[t])));
    }
  }
}

void MappedRun::take_crop() {
  if (!plan_.crop) return;
  const double diameter = file_.header().statics.mean_diameter;
  const Crop& crop = *plan_.crop;
  const MapExtent asked{crop.x0 * diameter, crop.x1 * diameter, crop.y0 * diameter, crop.y1 * diameter};
  if (asked.x_min < extent_.x_min || asked.x_max > extent_.x_max || asked.y_min < extent_.y_min ||
      asked.y_max > extent_.y_max)
    throw Error(ExitCode::usage,
                formatted("--crop %g,%g,%g,%g", crop.x0, crop.y0, crop.x1, crop.y1) +
                    formatted(" leaves the bed, which goes from %.2f,%.2f to %.2f,%.2f in mean diameters",
                              extent_.x_min / diameter, extent_.y_min / diameter, extent_.x_max / diameter,
                              extent_.y_max / diameter));
  extent_ = asked;
}

void MappedRun::load(std::size_t k) {
  if (current_ == k) return;
  const bool needed = any_layer(plan_, needs_reference);
  if (needed && since_ && before_ != since_) {
    reference_ = file_.frame(*since_);
    before_ = since_;
  } else if (needed && !since_ && k > 0) {
    reference_ = current_ == k - 1 ? std::move(frame_) : file_.frame(k - 1);
    before_ = k - 1;
  }
  frame_ = as_mapped(file_.frame(k));
  current_ = k;
}

Frame MappedRun::as_mapped(Frame frame) const {
  if (!shows_gamma(plan_)) return frame;
  return mapped_frame(std::move(frame), file_.header().statics, plan_.maps[0]);
}

const Frame* MappedRun::reference() const { return before_ && *before_ < *current_ ? &reference_ : nullptr; }

void MappedRun::fit_motion(std::span<const std::size_t> frames) {
  if (!any_layer(plan_, needs_reference)) return;
  MotionSample sample;
  for (const std::size_t k : frames) {
    load(k);
    sample.add({frame_, file_.header().statics, reference(), !since_, {}});
  }
  for (MapSettings& map : plan_.maps) map.motion = sample.ranges();
}

FrameView MappedRun::view(std::size_t k, std::size_t map) {
  load(k);
  const MapSettings& settings = plan_.maps[map];
  std::span<const ClusterColour> colours;
  if (!cluster_colours_.empty()) colours = cluster_colours_[k];
  const MapFrame frame{frame_, file_.header().statics, reference(), !since_, colours};
  FrameView view = make_map(frame, settings, extent_);
  for (std::size_t t = 0; t < plan_.traces.size(); ++t)
    view.traces.push_back(
        make_trace(plan_.traces[t], series_[t].tilts, series_[t].values, settings, frame_.tilt));
  return view;
}

std::string MappedRun::key(std::size_t k, std::size_t map) const {
  PictureKey key;
  add_run(key, file_.header());
  add_settings(key, plan_.maps[map], plan_.width, extent_);
  add_frame(key, instants_[k].step, instants_[k].tilt);
  if (any_layer(plan_, needs_reference))
    key.add("since", since_ ? std::to_string(instants_[*since_].step) : "frame before");
  for (std::size_t t = 0; t < plan_.traces.size(); ++t) {
    key.add("trace", std::string(trace_name(plan_.traces[t])));
    key.add("tilts", series_[t].tilts);
    key.add("values", series_[t].values);
  }
  return key.text();
}

MappedRun open_mapped_run(const std::string& path, const MapPlan& plan, bool quiet) {
  std::optional<CountProgress> line;
  return MappedRun(path, plan, [&](std::size_t read, std::size_t count) {
    if (!line) line.emplace("reading", count, quiet);
    line->show(read);
  });
}

}  // namespace talus
