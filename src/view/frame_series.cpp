#include "view/frame_series.h"

#include <exception>
#include <utility>

namespace talus {

FrameSeries::FrameSeries(const RunStatics& statics, ReadFrame read)
    : statics_(statics),
      read_(std::move(read)),
      extent_(bed_extent(statics)),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

void FrameSeries::begin(const OverloadRule& rule, std::vector<FrameRecord> known) {
  rule_ = rule;
  values_ = std::move(known);
  known_ = values_.size();
  colours_.clear();
  tracker_ = {};
  const std::scoped_lock lock(shared_.mutex);
  ++shared_.turn;
  shared_.rule = rule;
  shared_.known = known_;
  shared_.ready.clear();
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

bool FrameSeries::take_in() {
  std::vector<Result> ready;
  {
    const std::scoped_lock lock(shared_.mutex);
    const bool failed = shared_.error != error_;
    error_ = shared_.error;
    if (shared_.ready.empty()) return failed;
    ready = std::exchange(shared_.ready, {});
    tracker_ = shared_.tracker;
  }
  for (Result& result : ready) {
    const std::size_t frame = colours_.size();
    if (frame >= known_ && frame < of_tilt_) values_.push_back(std::move(result.values));
    colours_.push_back(std::move(result.colours));
    extend(extent_, result.extent);
  }
  return true;
}

FrameSeries::Result FrameSeries::measure(const Frame& stored, const OverloadRule& rule, bool with_values,
                                         ClusterColours& tracker) const {
  const Frame frame = mapped_frame(stored, statics_, rule.l_min);
  const BedFrame bed{frame, statics_};
  const Clusters clusters = overloaded_clusters(bed, rule);
  Result result;
  result.extent = bed_extent(statics_);
  extend(result.extent, bed);
  result.colours = tracker.next(clusters);
  if (with_values) result.values = overload_record(bed, clusters, rule);
  return result;
}

void FrameSeries::work(const std::stop_token& stop) {
  int turn = 0;
  std::size_t next = 0;
  ClusterColours tracker;
  OverloadRule rule;
  std::unique_lock lock(shared_.mutex);
  for (;;) {
    const bool anything = shared_.changed.wait(lock, stop, [&] {
      return shared_.turn != turn || (turn > 0 && next < shared_.frames && shared_.error.empty());
    });
    if (!anything || stop.stop_requested()) return;
    if (shared_.turn != turn) {
      turn = shared_.turn;
      rule = shared_.rule;
      next = 0;
      tracker = {};
      continue;  // there may be no frame yet
    }
    const bool with_values = next >= shared_.known && next < shared_.of_tilt;
    lock.unlock();
    Result result;
    std::string error;
    try {
      result = measure(*read_(next), rule, with_values, tracker);
    } catch (const std::exception& failure) {
      error = failure.what();
    }
    lock.lock();
    if (shared_.turn != turn) continue;
    shared_.error = error;
    if (!error.empty()) continue;
    shared_.ready.push_back(std::move(result));
    shared_.tracker = tracker;
    ++next;
  }
}

}  // namespace talus
