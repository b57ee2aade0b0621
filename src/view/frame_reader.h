#pragma once
/// The thread that reads ahead for the window.

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "pictures/picture_series.h"
#include "view/frame_source.h"
#include "view/frame_values.h"
#include "view/selection.h"

namespace talus::view {

/// Reads and evaluates frames in its own thread, which answers the newest question of each of three channels,
/// in this order: the frame that will probably be shown next, the history of a contact, and the values of all
/// frames. All members must be called from one other thread.
class FrameReader {
 public:
  /// Nothing is read before something is requested.
  FrameReader(const RunStatics& statics, std::shared_ptr<FrameSource> frames);
  /// Finishes the frame in progress.
  ~FrameReader() = default;
  FrameReader(const FrameReader&) = delete;
  FrameReader& operator=(const FrameReader&) = delete;

  /// Requests mapped_frame of frame k, for neighbourhoods of diameter l_min (D).
  void prepare(std::size_t k, double l_min);
  /// Returns that frame, for which it waits only if its reading has begun. Returns null if another frame was
  /// requested, if grains are missing, or if reading failed (reading it again reports the reason).
  std::shared_ptr<const Frame> take(std::size_t k, double l_min);

  /// Requests the history of a contact, or of none.
  void follow(const std::optional<ContactKey>& contact);
  /// Requests the values of all frames by this rule. Those in `known` are not recomputed.
  void evaluate(const pictures::OverloadRule& rule, std::vector<analysis::FrameRecord> known);
  /// Sets the number of frames, and how many belong to the tilt: only these have values.
  void set_counts(std::size_t frames, std::size_t of_tilt);

  // Each collects what has been read; returns whether there was anything. Everything below, and what the
  // pictures know of the frames added, changes only here and with a new question.
  bool collect_history();
  bool collect_values(pictures::PictureSeries& pictures);

  const std::optional<ContactKey>& contact() const { return contact_; }
  /// Returns the history of the contact read so far. A frame that cannot be read ends it.
  const std::vector<HistoryInstant>& history() const { return history_; }
  const pictures::OverloadRule& rule() const { return rule_; }
  /// Returns the values known so far, of the first frames of the tilt.
  const std::vector<analysis::FrameRecord>& values() const { return values_; }
  /// Returns the extent of the bed over all frames read for their values.
  const pictures::MapExtent& extent() const { return extent_; }
  /// Returns the reason why values end early; empty if they do not.
  const std::string& error() const { return error_; }

 private:
  using PreparedFrame = std::pair<std::size_t, double>;  ///< frame, and l_min (D)
  /// Questions about all frames, with their progress, which belongs to the thread.
  struct HistoryTask {
    ContactKey contact;
    std::size_t next = 0;
    std::vector<HistoryInstant> ready{};
  };
  struct ValuesTask {
    pictures::PictureSeries pictures;
    std::size_t known = 0;  ///< number of the first frames whose values are not needed
    std::vector<analysis::FrameRecord> ready{};
    std::string error{};
  };

  void work(const std::stop_token& stop);
  bool history_is_due() const { return history_task_ && history_task_->next < frames_; }
  bool values_are_due() const;
  // Each performs one step of its channel; the lock is released while it reads.
  void prepare_frame(std::unique_lock<std::mutex>& lock);
  void read_history(std::unique_lock<std::mutex>& lock);
  void read_values(std::unique_lock<std::mutex>& lock);

  const RunStatics statics_;
  const std::shared_ptr<FrameSource> source_;
  std::optional<ContactKey> contact_;
  std::vector<HistoryInstant> history_;
  pictures::OverloadRule rule_;
  std::vector<analysis::FrameRecord> values_;
  pictures::MapExtent extent_;
  std::string error_;

  // Shared by both threads, protected by the mutex.
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::size_t frames_ = 0, of_tilt_ = 0;
  std::optional<PreparedFrame> wanted_, in_progress_, prepared_;
  std::shared_ptr<const Frame> mapped_;  ///< answer for prepared_; null if it could not be read
  std::shared_ptr<HistoryTask> history_task_;
  std::shared_ptr<ValuesTask> values_task_;
  std::optional<pictures::SeenFrames> seen_frames_;  ///< empty once it has been collected
  pictures::MapExtent read_extent_;

  std::jthread thread_;  ///< last member: it is joined before the others are destroyed
};

}  // namespace talus::view
