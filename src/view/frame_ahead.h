#pragma once
/// Next frame of a replay, prepared while the current one is drawn.

#include <cstddef>
#include <future>
#include <memory>
#include <optional>

#include "core/snapshot.h"
#include "view/frame_source.h"

namespace talus::view {

/// A frame as it is stored, and the same frame with the gamma of neighbourhoods (mapped_frame).
struct ShownFrame {
  std::shared_ptr<const Frame> stored, mapped;
};

/// Prepares one frame at a time in the background. All members must be called from one thread.
class FrameAhead {
 public:
  FrameAhead(RunStatics statics, ReadFrame read);
  /// Waits for the frame in progress.
  ~FrameAhead() = default;
  FrameAhead(const FrameAhead&) = delete;
  FrameAhead& operator=(const FrameAhead&) = delete;

  /// Begins to prepare frame k with the gamma of neighbourhoods of diameter l_min (D), reading it unless it
  /// is `known`. Does nothing if another frame is in progress or no thread is available.
  void begin(std::size_t k, double l_min, const std::shared_ptr<const Frame>& known = nullptr);
  /// Returns frame k if it was the last one begun, with the same l_min; waits until it is ready. Returns
  /// nothing if something else was begun, if grains are missing, or if reading failed (reading it again
  /// reports the reason).
  std::optional<ShownFrame> take(std::size_t k, double l_min);

 private:
  struct Request {
    std::size_t frame = 0;
    double l_min = 0.0;
    bool operator==(const Request&) const = default;
  };

  const RunStatics statics_;
  const ReadFrame read_;
  Request request_;
  std::future<std::optional<ShownFrame>>
      made_;  ///< last member: it is waited for before the others are destroyed
};

}  // namespace talus::view
