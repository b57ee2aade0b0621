#pragma once
/// Frames of the run shown: those of a file, or those that a live run (live_run.h) has recorded.

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "io/run_file.h"

namespace talus::view {

/// Instants of the frames of a run, those of a flow after failure last.
struct RunInstants {
  std::vector<double> tilts;   ///< rad, one per frame
  std::vector<double> times;   ///< s, one per frame
  std::size_t tilt_count = 0;  ///< number of frames of the tilt, which come first

  /// Returns the first ones of these tilts or times, those of the tilt.
  std::vector<double> of_tilt(const std::vector<double>& all) const {
    return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(tilt_count)};
  }
};

/// Frames of a run for several threads. Only `read` and `frame` may be called from any thread.
class FrameSource {
 public:
  FrameSource() = default;
  virtual ~FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  std::size_t count() const { return instants_.tilts.size(); }
  const RunInstants& instants() const { return instants_; }
  /// Returns frame k. Throws as RunFile::frame does.
  virtual std::shared_ptr<const Frame> read(std::size_t k) = 0;
  /// Returns frame k, which is shown or will be soon.
  virtual std::shared_ptr<const Frame> frame(std::size_t k) { return read(k); }

 protected:
  RunInstants instants_;
};

/// Frames of a run file that is replayed, the current one of them, and its motion during playback.
class Replay final : public FrameSource {
 public:
  /// Opens a run. Throws as RunFile::open does, and Error(bad_data) if the run has no frames.
  explicit Replay(const std::string& path);

  /// Header, tilts and results; until a second thread runs, also the series.
  const io::RunFile& file() const { return file_; }
  std::shared_ptr<const Frame> read(std::size_t k) override;
  /// Returns frame k. The frames requested most recently are cached, up to about 256 MB.
  std::shared_ptr<const Frame> frame(std::size_t k) override;
  /// Caches frame k.
  void keep(std::size_t k, const std::shared_ptr<const Frame>& frame);

  std::size_t index() const { return index_; }
  /// Goes to that frame, or to the last one if the number is too large.
  void go_to(std::size_t frame);
  bool playing() const { return playing_; }
  /// Starts or stops playback; from the last frame it starts again at the first.
  void play(bool on);
  double speed() const { return speed_; }
  /// Sets the speed in degrees of tilt per second; at least 0.001.
  void set_speed(double degrees_per_second);
  /// Advances a playing replay by `seconds`; returns whether the frame has changed. Playback stops at the
  /// last frame. Frames of the flow after failure follow each other at the same intervals as those of the
  /// tilt, whatever their tilt.
  bool advance(double seconds);

 private:
  double seconds_shown(std::size_t k) const;

  std::mutex file_mutex_;  ///< held while reading, because HDF5 admits one thread at a time
  io::RunFile file_;
  std::mutex kept_mutex_;  ///< another one, so that a cached frame is returned while others are read
  std::deque<std::pair<std::size_t, std::shared_ptr<const Frame>>> kept_;  ///< most recently requested first
  std::size_t index_ = 0;
  bool playing_ = false;
  double speed_ = 2.0;   ///< deg/s
  double waited_ = 0.0;  ///< s since the current frame was reached
};

}  // namespace talus::view
