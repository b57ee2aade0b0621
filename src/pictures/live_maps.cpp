#include "pictures/live_maps.h"

#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <utility>

#include "base/output_file.h"
#include "pictures/picture_files.h"

namespace talus::pictures {
namespace {

/// Space above the bed when it begins to tilt, relative to its depth: room for all later frames.
constexpr double margin_above = 0.05;

/// Largest number of frames that wait to be drawn.
constexpr std::size_t frames_waiting = 4;

void refuse_pictures(const std::string& folder, const MapPlan& plan) {
  for (const std::string& name : names_in(folder))
    for (const MapSettings& map : plan.maps) {
      if (name.starts_with(name_of(map) + "_") && name.ends_with(".png"))
        throw Error(ExitCode::cannot_create,
                    "{} already contains pictures of the map {}; choose another folder, or give --overwrite "
                    "to replace them and the run",
                    folder, name_of(map));
    }
}

/// Returns the extent of the bed when it begins to tilt, with some space above.
MapExtent live_extent(const BedFrame& bed) {
  MapExtent extent = bed_extent(bed.statics);
  extend(extent, bed);
  extent.y_max += margin_above * bed.statics.depth;
  return extent;
}

}  // namespace

MapPlan plan_live_maps(const MapOptions& options) {
  MapPlan plan = plan_maps(options);
  settle_theta_c(plan, not_known);
  return plan;
}

LiveMaps::LiveMaps(const MapPlan& plan, std::string folder, bool resumed, bool overwrite, Warn warn)
    : folder_(std::move(folder)), resumed_(resumed), warn_(std::move(warn)), tasks_(frames_waiting) {
  series_.plan = plan;
  // A context belongs to the thread that makes it.
  tasks_.post(
      [this] { renderer_ = std::make_unique<render::Renderer>(render::make_context(series_.plan.context)); });
  tasks_.finish();
  prepare_folder(folder_);
  if (!resumed && !overwrite) refuse_pictures(folder_, series_.plan);
}

LiveMaps::~LiveMaps() {
  tasks_.drop();  // a run that ends early draws them when it is resumed
  tasks_.post([this] { renderer_.reset(); });
  tasks_.finish();
}

void LiveMaps::begin(const io::RunHeader& header, const std::string& path, double step, bool goes_by_time) {
  series_.run = header;
  series_.goes_by_time = goes_by_time;
  series_.path = path;
  decimals_ = std::max(2, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
}

void LiveMaps::add_frames(const io::RunFile& file) {
  for (std::size_t k = 0; k < file.all_frame_tilts().size(); ++k)
    tasks_.post([this, frame = file.frame(k)] { draw_or_fail(frame); });
  finish();
}

void LiveMaps::add(const Frame& frame) {
  tasks_.post([this, stored = io::as_stored(frame)] { draw_or_fail(stored); });
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
  warn_(message + "; the run continues without drawing further maps");
}

void LiveMaps::draw(Frame frame) {
  const MapPlan& plan = series_.plan;
  if (series_.seen_frames.instants.empty()) series_.extent = live_extent({frame, series_.run.statics});
  frame = as_mapped(series_, std::move(frame));
  talus::pictures::add_frame(series_, frame);
  const std::size_t k = series_.seen_frames.instants.size() - 1;
  for (std::size_t map = 0; map < plan.maps.size(); ++map) {
    const PictureFile file = picture_file(series_, folder_, k, map, decimals_);
    std::error_code none;
    if (resumed_ && std::filesystem::is_regular_file(file.path, none)) continue;
    render::FrameView view = picture(series_, k, frame, before_ ? &*before_ : nullptr, map);
    render::write_png(file.path, renderer_->draw(sheet_of_plan(std::move(view), plan, renderer_->font())),
                      picture_texts(file.source), plan.page_width());
  }
  before_ = std::move(frame);
}

}  // namespace talus::pictures
