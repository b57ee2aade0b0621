#pragma once
/// Places of a replayed run worth going to.

#include <optional>
#include <span>
#include <vector>

#include "core/observables.h"
#include "view/frame_values.h"

namespace talus {

enum class Landmark {
  first,
  theta_d,      ///< where contraction turns into dilation (paper, Fig. 14)
  length_jump,  ///< where the largest l_c jumps (paper, Fig. 12b)
  percolation,  ///< the first frame in which a cluster of overloaded grains spans from floor to surface
  theta_c,      ///< the last frame before the slope fails
  last,
};

/// The frame in which a cluster first spans; none where none does.
std::optional<std::size_t> percolation_frame(std::span<const FrameRecord> frames);

/// The frame nearest to the onset of dilation, up to theta_c (rad; NaN: not known): of the smallest volume
/// strain, as analyses find it.
std::optional<std::size_t> dilation_frame(std::span<const ObservableRow> rows,
                                          const std::vector<double>& tilts, double theta_c);

/// The frame after the largest jump of the largest l_c, up to theta_c (rad; NaN: not known) and to the first
/// frame that reaches `cut` (m). All frames of the tilt are to be there.
std::optional<std::size_t> length_jump_frame(std::span<const FrameRecord> frames, double cut, double theta_c);

}  // namespace talus
