#pragma once
/// The frames of a run that is shown: of a file, or those that a run has recorded while it is computed.

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/run_file.h"
#include "view/run_clock.h"

namespace talus::view {

/// Frame k of a run, for any thread.
using ReadFrame = std::function<std::shared_ptr<const Frame>(std::size_t k)>;

/// Frames of a run for several threads. All but `read` is for the thread that shows them.
class FrameSource {
 public:
  FrameSource() = default;
  virtual ~FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  std::size_t count() const { return instants_.tilts.size(); }
  /// When they are; without theta_c.
  const RunInstants& instants() const { return instants_; }
  /// Frame k, for any thread. Throws as RunFile::frame does.
  virtual std::shared_ptr<const Frame> read(std::size_t k) = 0;
  /// The same for the thread that shows it.
  virtual std::shared_ptr<const Frame> frame(std::size_t k) { return read(k); }

 protected:
  RunInstants instants_;
};

/// Frames that a run has recorded; one thread adds, and another reads.
class RecordedFrames final : public FrameSource {
 public:
  void add(const std::vector<std::shared_ptr<const Frame>>& more);
  std::shared_ptr<const Frame> read(std::size_t k) override;

 private:
  std::mutex mutex_;
  std::vector<std::shared_ptr<const Frame>> frames_;
};

/// Whose turn it is to read: HDF5 is for one thread at a time, also where the files are different ones. A
/// thread may take it again while it has it.
using ReadingTurn = std::recursive_mutex;

/// The frames of a run file.
class RunFrames final : public FrameSource {
 public:
  /// Runs that are open at the same time share a turn. Throws as RunFile::open does, and Error(bad_data)
  /// where the run has no frames.
  explicit RunFrames(const std::string& path,
                     std::shared_ptr<ReadingTurn> turn = std::make_shared<ReadingTurn>());
  ~RunFrames() override;
  RunFrames(const RunFrames&) = delete;
  RunFrames& operator=(const RunFrames&) = delete;

  /// Header, tilts and results; before there is a second thread, also series.
  const io::RunFile& file() const { return *file_; }
  std::shared_ptr<const Frame> read(std::size_t k) override;
  /// Those asked for last are kept, up to some 256 MB.
  std::shared_ptr<const Frame> frame(std::size_t k) override;
  /// Frame k if it is kept; null else.
  std::shared_ptr<const Frame> kept(std::size_t k) const;
  /// Frame k, which somebody else has read, is kept as if it had been asked for.
  void keep(std::size_t k, std::shared_ptr<const Frame> frame);

 private:
  std::shared_ptr<ReadingTurn> turn_;
  std::optional<io::RunFile> file_;
  std::deque<std::pair<std::size_t, std::shared_ptr<const Frame>>> kept_;  ///< the last asked for in front
};

/// Which frame is shown, and how playing moves it on.
class Replay {
 public:
  explicit Replay(std::shared_ptr<const RunFrames> frames) : frames_(std::move(frames)) {}

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

 private:
  double seconds_shown(std::size_t k) const;

  std::shared_ptr<const RunFrames> frames_;
  std::size_t index_ = 0;
  bool playing_ = false;
  double speed_ = 2.0;   ///< deg/s
  double waited_ = 0.0;  ///< s since the frame shown was reached
};

}  // namespace talus::view
