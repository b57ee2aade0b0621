#pragma once
/// Separates the frames of a run's tilt from those of the flow after failure.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace talus::io {

/// Returns the number of frames, from the first one, that belong to the tilt: up to the first highest tilt
/// (rad) or, with a programme of the tilt, whose `last_tilt_step` is known, up to the last frame not after
/// that step.
inline std::size_t frames_of_tilt(const std::vector<double>& tilts, const std::vector<std::int64_t>& steps,
                                  const std::optional<std::int64_t>& last_tilt_step) {
  if (last_tilt_step)
    return static_cast<std::size_t>(std::ranges::upper_bound(steps, *last_tilt_step) - steps.begin());
  const auto highest = std::ranges::max_element(tilts);
  return static_cast<std::size_t>((highest == tilts.end() ? highest : highest + 1) - tilts.begin());
}

}  // namespace talus::io
