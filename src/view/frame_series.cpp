#include "view/frame_series.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <utility>

namespace talus::view {
namespace {

/// Returns the pictures of a run before any of its frames is added.
pictures::PictureSeries pictures_of_clusters(const RunStatics& statics) {
  pictures::PictureSeries pictures;
  pictures.run.statics = statics;
  pictures.extent = pictures::bed_extent(statics);
  pictures.plan.maps.emplace_back().layers = {pictures::MapKind::clusters};
  return pictures;
}

/// Adds the frame to the pictures and returns its record, if requested.
std::optional<analysis::FrameRecord> add_and_measure(pictures::PictureSeries& pictures, const Frame& stored,
                                                     bool with_values) {
  const pictures::OverloadRule& rule = pictures.plan.maps[0];
  const Frame frame = pictures::as_mapped(pictures, stored);
  const BedFrame bed{frame, pictures.run.statics};
  const analysis::Clusters clusters = pictures::overloaded_clusters(bed, rule);
  pictures::extend(pictures.extent, bed);
  pictures::add_frame(pictures, frame, clusters);
  return with_values ? std::optional(overload_record(bed, clusters, rule)) : std::nullopt;
}

}  // namespace

FrameSeries::FrameSeries(const RunStatics& statics, ReadFrame read)
    : statics_(statics),
      read_(std::move(read)),
      extent_(pictures::bed_extent(statics)),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

void FrameSeries::begin(const pictures::OverloadRule& rule, std::vector<analysis::FrameRecord> known) {
  rule_ = rule;
  values_ = std::move(known);
  const std::scoped_lock lock(shared_.mutex);
  ++shared_.turn;
  shared_.rule = rule;
  shared_.known = values_.size();
  shared_.ready.clear();
  shared_.seen_frames.reset();
  shared_.error.clear();
  shared_.changed.notify_all();
}

void FrameSeries::set_counts(std::size_t frames, std::size_t of_tilt) {
  of_tilt_ = of_tilt;
  const std::scoped_lock lock(shared_.mutex);
  shared_.frames = frames;
  shared_.of_tilt = of_tilt;
  shared_.changed.notify_all();
}

bool FrameSeries::collect_ready(pictures::PictureSeries& pictures) {
  const std::scoped_lock lock(shared_.mutex);
  const bool failed = shared_.error != error_;
  error_ = shared_.error;
  if (!shared_.seen_frames) return failed;
  pictures.seen_frames = *std::exchange(shared_.seen_frames, std::nullopt);
  extent_ = shared_.extent;
  std::ranges::move(shared_.ready, std::back_inserter(values_));
  shared_.ready.clear();
  return true;
}

void FrameSeries::work(const std::stop_token& stop) {
  int turn = 0;
  pictures::PictureSeries pictures = pictures_of_clusters(statics_);
  pictures::OverloadRule& rule = pictures.plan.maps[0];
  std::unique_lock lock(shared_.mutex);
  for (;;) {
    const bool anything = shared_.changed.wait(lock, stop, [&] {
      return shared_.turn != turn ||
             (turn > 0 && pictures.seen_frames.instants.size() < shared_.frames && shared_.error.empty());
    });
    if (!anything || stop.stop_requested()) return;
    if (shared_.turn != turn) {
      turn = shared_.turn;
      rule = shared_.rule;
      pictures.seen_frames = {};
      continue;  // the run may have no frame yet
    }
    const std::size_t next = pictures.seen_frames.instants.size();
    const bool with_values = next >= shared_.known && next < shared_.of_tilt;
    lock.unlock();
    std::optional<analysis::FrameRecord> values;
    std::string error;
    try {
      values = add_and_measure(pictures, *read_(next), with_values);
    } catch (const std::exception& failure) {
      error = failure.what();
    }
    lock.lock();
    if (shared_.turn != turn) continue;
    shared_.error = error;
    if (!error.empty()) continue;
    if (values) shared_.ready.push_back(std::move(*values));
    shared_.seen_frames = pictures.seen_frames;
    shared_.extent = pictures.extent;
  }
}

}  // namespace talus::view
