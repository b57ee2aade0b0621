#include "view/frame_ahead.h"

#include <chrono>
#include <exception>
#include <system_error>
#include <utility>

#include "pictures/overload_rule.h"

namespace talus::view {

FrameAhead::FrameAhead(RunStatics statics, ReadFrame read)
    : statics_(std::move(statics)), read_(std::move(read)) {}

void FrameAhead::begin(std::size_t k, double l_min, const std::shared_ptr<const Frame>& known) {
  const Request next{k, l_min};
  if (made_.valid() &&
      (next == request_ || made_.wait_for(std::chrono::seconds(0)) != std::future_status::ready))
    return;
  const auto make = [this, k, l_min, known]() -> std::optional<ShownFrame> {
    try {
      ShownFrame shown{known ? known : read_(k), nullptr};
      if (shown.stored->x.size() != statics_.radius.size()) return std::nullopt;
      shown.mapped = std::make_shared<const Frame>(pictures::mapped_frame(*shown.stored, statics_, l_min));
      return shown;
    } catch (const std::exception&) {
      return std::nullopt;
    }
  };
  try {
    made_ = std::async(std::launch::async, make);
    request_ = next;
  } catch (const std::system_error&) {  // no thread is available: the frame is computed when it is shown
  }
}

std::optional<ShownFrame> FrameAhead::take(std::size_t k, double l_min) {
  if (!made_.valid() || !(request_ == Request{k, l_min})) return std::nullopt;
  return made_.get();
}

}  // namespace talus::view
