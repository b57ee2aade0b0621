#pragma once
/// Small types shared by every room.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>

namespace talus {

/// Index of a grain, a body or a contact in an array. Ids of grains never change during a run.
using Index = std::int32_t;

/// NaN, for a missing value.
inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// A vector in the plane, in the frame of the bed: x along the bed (downslope when the tilt is positive),
/// y across it, away from the floor.
struct Vec2 {
  double x = 0.0;
  double y = 0.0;
};

/// A 2 x 2 tensor in the frame of the bed; `xy` is M_12 of the paper. core/tensor.h gives its matrix view.
struct Tensor2 {
  double xx = 0.0;
  double xy = 0.0;
  double yx = 0.0;
  double yy = 0.0;
};

// Callbacks for progress and interruption of long operations.

/// Callback with the number of finished items and the total; may be empty.
using CountDone = std::function<void(std::size_t done, std::size_t count)>;

struct Watch {
  CountDone progress;             ///< may be empty
  std::function<bool()> stopped;  ///< whether to stop; called before each item
};

}  // namespace talus
