#pragma once
/// The frame of a replay that will be shown next, made while the one before it is drawn.

#include <cstddef>
#include <future>
#include <memory>
#include <optional>

#include "core/snapshot.h"
#include "view/frame_source.h"

namespace talus::view {

/// A frame as it is stored, and with the gamma of neighbourhoods (mapped_frame).
struct ShownFrame {
  std::shared_ptr<const Frame> stored, mapped;
};

/// Makes one frame at a time in the background. All members are for one thread.
class FrameAhead {
 public:
  FrameAhead(RunStatics statics, ReadFrame read);
  /// Finishes what is under way.
  ~FrameAhead() = default;
  FrameAhead(const FrameAhead&) = delete;
  FrameAhead& operator=(const FrameAhead&) = delete;

  /// Begins to make frame k, with neighbourhoods from l_min (D) on; reads it where it is not known. Does
  /// nothing where another is under way, or no thread can be had.
  void begin(std::size_t k, double l_min, const std::shared_ptr<const Frame>& known = nullptr);
  /// Frame k, where it was begun last with that l_min; waits until it is made. None where something else
  /// was begun, where it has not all grains, or where it could not be read: reading it again tells why.
  std::optional<ShownFrame> take(std::size_t k, double l_min);

 private:
  struct Asked {
    std::size_t frame = 0;
    double l_min = 0.0;
    bool operator==(const Asked&) const = default;
  };

  const RunStatics statics_;
  const ReadFrame read_;
  Asked asked_;
  std::future<std::optional<ShownFrame>> made_;  ///< the last: it is waited for before the rest goes
};

}  // namespace talus::view
