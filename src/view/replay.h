#pragma once
/// A run file that is played.

#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "io/run_file.h"

namespace talus {

/// Whose turn it is to read: HDF5 is for one thread at a time, also where the files are different ones. A
/// thread may take it again while it has it.
using ReadingTurn = std::recursive_mutex;

/// The frames of a run file for two threads: one shows them while another goes through all of them.
class RunFrames {
 public:
  /// Runs that are open at the same time share a turn. Throws as RunFile::open does, and Error(bad_data)
  /// where the run has no frames.
  explicit RunFrames(const std::string& path,
                     std::shared_ptr<ReadingTurn> turn = std::make_shared<ReadingTurn>());
  ~RunFrames();
  RunFrames(const RunFrames&) = delete;
  RunFrames& operator=(const RunFrames&) = delete;

  /// Header, tilts and results; before there is a second thread, also series.
  const RunFile& file() const { return *file_; }
  /// Throws as RunFile::frame does.
  std::shared_ptr<const Frame> read(std::size_t k);

 private:
  std::shared_ptr<ReadingTurn> turn_;
  std::optional<RunFile> file_;
};

/// Which frame is shown, and how playing moves it on.
class Replay {
 public:
  explicit Replay(std::shared_ptr<RunFrames> frames);

  std::size_t count() const { return frames_->file().all_frame_tilts().size(); }
  std::size_t index() const { return index_; }
  /// The last frame where there is none with that number.
  void go_to(std::size_t frame);

  bool playing() const { return playing_; }
  /// From the first frame where it is at the last.
  void play(bool on);
  double speed() const { return speed_; }
  /// Degrees of tilt a second; not below a thousandth.
  void set_speed(double degrees_per_second);
  /// Moves a playing replay on by so many seconds; true where another frame is shown. It stops at the last.
  /// Frames of a flow after failure follow each other as those of the tilt do, whatever their tilt.
  bool advance(double seconds);

  /// Frame k; those asked for last are kept, up to some 256 MB. Throws as RunFile::frame does.
  std::shared_ptr<const Frame> frame(std::size_t k);
  /// Frame k if it is kept; null else.
  std::shared_ptr<const Frame> kept(std::size_t k) const;
  /// Frame k, which somebody else has read, is kept as if it had been asked for.
  void keep(std::size_t k, std::shared_ptr<const Frame> frame);

 private:
  double seconds_shown(std::size_t k) const;

  std::shared_ptr<RunFrames> frames_;
  std::deque<std::pair<std::size_t, std::shared_ptr<const Frame>>> kept_;  ///< the last asked for in front
  std::size_t index_ = 0;
  bool playing_ = false;
  double speed_ = 2.0;   ///< deg/s
  double waited_ = 0.0;  ///< s since the frame shown was reached
};

}  // namespace talus
