#include "view/landmarks.h"

#include <algorithm>
#include <cmath>

#include "analysis/transition.h"
#include "core/trigonometry.h"
#include "pictures/frame_choice.h"

namespace talus {

std::optional<std::size_t> percolation_frame(std::span<const FrameRecord> frames) {
  const auto spans = [](const FrameRecord& frame) { return frame.thresholds.front().spans_depth != 0; };
  const auto first = std::ranges::find_if(frames, spans);
  if (first == frames.end()) return std::nullopt;
  return static_cast<std::size_t>(first - frames.begin());
}

std::optional<std::size_t> dilation_frame(std::span<const ObservableRow> rows,
                                          const std::vector<double>& tilts, double theta_c) {
  std::vector<double> row_tilts, strains;
  for (const ObservableRow& row : rows) {
    row_tilts.push_back(at(row, Observable::tilt));
    strains.push_back(at(row, Observable::volume_strain));
  }
  return nearest_frame(tilts, dilation_onset(row_tilts, strains, theta_c, radians(dilation_window)).tilt);
}

std::optional<std::size_t> length_jump_frame(std::span<const FrameRecord> frames, double cut,
                                             double theta_c) {
  std::vector<double> tilts, lengths;
  for (const FrameRecord& frame : frames) {
    tilts.push_back(frame.tilt);
    lengths.push_back(frame.thresholds.front().lc_max);
  }
  return nearest_frame(tilts, length_jump(tilts, lengths, theta_c, cut).tilt);
}

}  // namespace talus
