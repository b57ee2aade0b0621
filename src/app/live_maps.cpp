#include "app/live_maps.h"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "app/output_files.h"
#include "app/picture_key.h"
#include "app/picture_names.h"
#include "core/trigonometry.h"
#include "maps/cluster_frame.h"
#include "render/png.h"

namespace talus {
namespace {

/// Above the bed when it begins to tilt, over its depth: pictures of one size hold all of its later frames.
constexpr double margin_above = 0.05;

/// Frames that may wait to be drawn.
constexpr std::size_t frames_waiting = 4;

void refuse_pictures(const std::string& folder, const MapPlan& plan) {
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    for (const MapSettings& map : plan.maps) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with(layers_name(map.layers) + "_") && name.ends_with(".png"))
        throw Error(ExitCode::cannot_create,
                    folder + " holds pictures of the map " + layers_name(map.layers) +
                        " already; choose another folder, or give --overwrite to replace them and the run");
    }
}

}  // namespace

MapPlan plan_live_maps(const MapOptions& options) {
  MapPlan plan = plan_maps(options);
  if (!needs_theta_c(plan) || options.theta_c) return plan;
  for (MapSettings& map : plan.maps) {
    map.theta_c = radians(assumed_theta_c);
    map.theta_c_assumed = true;
  }
  return plan;
}

LiveMaps::LiveMaps(MapPlan plan, std::string folder, bool resumed, bool overwrite)
    : plan_(std::move(plan)), folder_(std::move(folder)), overwrite_(overwrite), tasks_(frames_waiting) {
  // A context belongs to the thread that makes it.
  tasks_.post([this] { renderer_ = std::make_unique<Renderer>(make_context(plan_.context)); });
  tasks_.finish();
  create_folder(folder_);
  if (!resumed && !overwrite_) refuse_pictures(folder_, plan_);
}

LiveMaps::~LiveMaps() {
  tasks_.drop();  // of a run that ends early: it draws them when it is resumed
  tasks_.post([this] { renderer_.reset(); });
  tasks_.finish();
}

void LiveMaps::begin(const RunHeader& header, const std::string& path, double step) {
  header_ = header;
  path_ = path;
  decimals_ = std::max(2, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
}

void LiveMaps::meet(const RunFile& file) {
  for (std::size_t k = 0; k < file.all_frame_tilts().size(); ++k)
    tasks_.post([this, frame = file.frame(k)] { draw_or_fail(frame); });
  finish();
}

void LiveMaps::add(const Frame& frame) {
  tasks_.post([this, stored = as_stored(frame)] { draw_or_fail(stored); });
}

void LiveMaps::finish() {
  tasks_.finish();
  if (failure_) throw *failure_;
}

void LiveMaps::draw_or_fail(Frame frame) {
  if (failure_) return;
  try {
    draw(std::move(frame));
  } catch (const Error& error) {
    fail(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    fail(ExitCode::out_of_memory, "out of memory");
  } catch (const std::exception& error) {
    fail(ExitCode::internal, error.what());
  }
}

void LiveMaps::fail(ExitCode code, const std::string& message) {
  failure_.emplace(code, message);
  std::fprintf(stderr, "talus: warning: %s; the run goes on, and no more of its maps are drawn\n",
               message.c_str());
}

std::string LiveMaps::name_of(const Frame& frame, const MapLayers& layers) const {
  const bool rising = frame.step == highest_.step;
  const std::string map = layers_name(layers);
  return (std::filesystem::path(folder_) /
          (rising ? tilt_name(map, frame.tilt, decimals_) : flow_name(map, frame.time - highest_.time)))
      .string();
}

std::string LiveMaps::key_of(const Frame& frame, const MapSettings& settings) const {
  PictureKey key;
  add_run(key, header_);
  add_settings(key, settings, plan_.width, *extent_);
  add_frame(key, frame.step, frame.tilt);
  return key.text();
}

void LiveMaps::draw(Frame frame) {
  const RunStatics& statics = header_.statics;
  if (!extent_) {
    extent_ = bed_extent(statics);
    extend(*extent_, frame, statics);
    extent_->y_max += margin_above * statics.depth;
  }
  if (shows_gamma(plan_)) frame = mapped_frame(std::move(frame), statics, plan_.maps[0]);
  if (!before_ || frame.tilt > highest_.tilt) highest_ = {frame.step, frame.time, frame.tilt};
  std::vector<ClusterColour> cluster_colours;
  if (draws_clusters(plan_))
    cluster_colours = colours_.next(overloaded_clusters(frame, statics, plan_.maps[0]));
  for (const MapSettings& map : plan_.maps) {
    const std::string path = name_of(frame, map.layers);
    const PictureMarks marks = {key_of(frame, map), picture_request("run", path_, plan_, {&map, 1}, path)};
    if (is_drawn(path, marks, overwrite_)) continue;
    const MapFrame of{frame, statics, before_ ? &*before_ : nullptr, true, cluster_colours};
    write_png(path, renderer_->draw(make_map(of, map, *extent_), plan_.width),
              picture_texts(marks, picture_source(path_, frame.tilt, map.layers)));
  }
  before_ = std::move(frame);
}

}  // namespace talus
