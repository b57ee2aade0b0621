#pragma once
/// What is worked out frame by frame, in the order of the run, while the view is used.

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

/// Reads frames in a thread of its own. All members are for one other thread.
class FrameSeries {
 public:
  /// `read` lives as long as the series. Nothing is read before begin.
  FrameSeries(const RunStatics& statics, ReadFrame read);
  /// Finishes the frame under way.
  ~FrameSeries() = default;
  FrameSeries(const FrameSeries&) = delete;
  FrameSeries& operator=(const FrameSeries&) = delete;

  /// All frames anew, by this rule. Values that are `known`, of the first frames, are not worked out again.
  void begin(const pictures::OverloadRule& rule, std::vector<analysis::FrameRecord> known);
  /// How many frames there are, and how many of them, the first, are of the tilt: only these have values.
  void set_counts(std::size_t frames, std::size_t of_tilt);

  /// Takes in what is ready; true where there was something. Only here does anything below change, and what
  /// the pictures of the run know of frames that were met.
  bool take_in(pictures::PictureSeries& pictures);

  const pictures::OverloadRule& rule() const { return rule_; }
  /// Of the first frames of the tilt, as far as they are known.
  const std::vector<analysis::FrameRecord>& values() const { return values_; }
  /// Whether all frames of the tilt have values.
  bool has_all_values() const { return values_.size() >= of_tilt_; }
  /// The bed in all frames met since the series was made.
  const pictures::MapExtent& extent() const { return extent_; }
  /// Why frames could not be read on; empty where they could.
  const std::string& error() const { return error_; }

 private:
  /// What both threads use, under `mutex`.
  struct Shared {
    std::mutex mutex;
    std::condition_variable_any changed;
    int turn = 0;  ///< counts the calls of begin; 0: none yet
    pictures::OverloadRule rule;
    std::size_t known = 0, frames = 0, of_tilt = 0;
    std::vector<analysis::FrameRecord> ready;
    std::optional<pictures::MetFrames> met;  ///< none where it has been taken in
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
  Shared shared_;
  std::jthread thread_;  ///< the last: it is joined before the rest goes
};

}  // namespace talus::view
