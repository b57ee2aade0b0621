#include "view/landmarks.h"

#include <algorithm>
#include <cmath>

#include "core/trigonometry.h"
#include "session/analysis_transition.h"

namespace talus {

std::optional<std::size_t> percolation_frame(std::span<const FrameValues> frames) {
  const auto first = std::ranges::find(frames, true, &FrameValues::spans);
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

std::optional<std::size_t> length_jump_frame(std::span<const FrameValues> frames, double cut,
                                             double theta_c) {
  std::vector<double> tilts, lengths;
  for (const FrameValues& frame : frames) {
    tilts.push_back(frame.tilt);
    lengths.push_back(frame.largest_length);
  }
  return nearest_frame(tilts, length_jump(tilts, lengths, theta_c, cut).tilt);
}

std::optional<std::size_t> nearest_frame(const std::vector<double>& tilts, double tilt) {
  if (tilts.empty() || std::isnan(tilt)) return std::nullopt;
  const auto nearest = std::ranges::min_element(tilts, {}, [tilt](double of) { return std::abs(of - tilt); });
  return static_cast<std::size_t>(nearest - tilts.begin());
}

}  // namespace talus
