#include "view/landmarks.h"

#include <algorithm>
#include <cmath>

#include "analysis/last_rise.h"
#include "analysis/transition.h"
#include "core/trigonometry.h"
#include "pictures/frame_choice.h"

namespace talus {
namespace {

/// The frame nearest to a tilt of the rise that begins with frame `first`.
std::optional<std::size_t> frame_in(std::size_t first, const std::vector<double>& tilts, double tilt) {
  const std::optional<std::size_t> nearest = nearest_frame(tilts, tilt);
  return nearest ? std::optional(first + *nearest) : std::nullopt;
}

}  // namespace

std::optional<std::size_t> percolation_frame(std::span<const FrameRecord> frames) {
  const auto spans = [](const FrameRecord& frame) { return frame.thresholds.front().spans_depth != 0; };
  const auto first = std::ranges::find_if(frames, spans);
  if (first == frames.end()) return std::nullopt;
  return static_cast<std::size_t>(first - frames.begin());
}

std::optional<std::size_t> dilation_frame(std::span<const ObservableRow> rows,
                                          const std::vector<double>& tilts, double theta_c) {
  std::vector<double> row_tilts, strains;
  for (const ObservableRow& row : rows_of_last_rise(rows)) {
    row_tilts.push_back(at(row, Observable::tilt));
    strains.push_back(at(row, Observable::volume_strain));
  }
  const SeriesPart rise = last_rise(tilts);
  return frame_in(rise.first, magnitudes(tilts, rise),
                  dilation_onset(row_tilts, strains, theta_c, radians(dilation_window)).tilt);
}

std::optional<std::size_t> length_jump_frame(std::span<const FrameRecord> frames, double cut,
                                             double theta_c) {
  const FramesOfRise rise = last_rise(frames);
  std::vector<double> lengths;
  for (const FrameRecord* frame : rise.frames) lengths.push_back(frame->thresholds.front().lc_max);
  return frame_in(rise.first, rise.tilts, length_jump(rise.tilts, lengths, theta_c, cut).tilt);
}

}  // namespace talus
