#pragma once
/// Results computed frame by frame, in order, in the background of the view.

#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "pictures/picture_series.h"
#include "view/frame_source.h"
#include "view/frame_values.h"

namespace talus::view {

/// Reads and evaluates frames in its own thread. All members must be called from one other thread.
class FrameSeries {
 public:
  /// `read` must outlive the series. Nothing is read before begin().
  FrameSeries(const RunStatics& statics, ReadFrame read);
  /// Finishes the frame in progress.
  ~FrameSeries() = default;
  FrameSeries(const FrameSeries&) = delete;
  FrameSeries& operator=(const FrameSeries&) = delete;

  /// Evaluates all frames with this rule. The values in `known`, of the first frames, are not recomputed.
  void begin(const pictures::OverloadRule& rule, std::vector<analysis::FrameRecord> known);
  /// Sets the number of frames, and how many of them (the first ones) belong to the tilt: only these have
  /// values.
  void set_counts(std::size_t frames, std::size_t of_tilt);

  /// Collects the finished results; returns whether there were any. Everything below, and what the pictures
  /// know of the frames added, changes only here.
  bool collect_ready(pictures::PictureSeries& pictures);

  const pictures::OverloadRule& rule() const { return rule_; }
  /// Returns the values known so far, of the first frames of the tilt.
  const std::vector<analysis::FrameRecord>& values() const { return values_; }
  /// Returns whether all frames of the tilt have values.
  bool has_all_values() const { return values_.size() >= of_tilt_; }
  /// Returns the extent of the bed over all frames read since the series was created.
  const pictures::MapExtent& extent() const { return extent_; }
  /// Returns the reason why reading stopped; empty if it did not.
  const std::string& error() const { return error_; }

 private:
  /// Data used by both threads, protected by `mutex`.
  struct SharedState {
    std::mutex mutex;
    std::condition_variable_any changed;
    int turn = 0;  ///< number of calls of begin(); 0: none yet
    pictures::OverloadRule rule;
    std::size_t known = 0, frames = 0, of_tilt = 0;
    std::vector<analysis::FrameRecord> ready;
    std::optional<pictures::SeenFrames> seen_frames;  ///< empty once it has been collected
    pictures::MapExtent extent;
    std::string error;
  };

  void work(const std::stop_token& stop);

  RunStatics statics_;
  ReadFrame read_;
  pictures::OverloadRule rule_;
  std::size_t of_tilt_ = 0;
  std::vector<analysis::FrameRecord> values_;
  pictures::MapExtent extent_;
  std::string error_;
  SharedState shared_;
  std::jthread thread_;  ///< last member: it is joined before the others are destroyed
};

}  // namespace talus::view
