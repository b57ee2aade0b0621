#include "analysis/failure/last_rise.h"

#include <cmath>

namespace talus::analysis {

SeriesPart last_rise(std::span<const double> tilts) {
  const auto rises = [&](std::size_t k) { return std::abs(tilts[k]) > std::abs(tilts[k - 1]); };
  const auto falls = [&](std::size_t k) { return std::abs(tilts[k]) < std::abs(tilts[k - 1]); };
  std::size_t top = tilts.empty() ? 0 : tilts.size() - 1;
  while (top > 0 && !rises(top)) --top;
  if (top == 0) return {0, tilts.size()};
  SeriesPart part{top, top + 1};
  while (part.first > 0 && !falls(part.first)) --part.first;
  while (part.end < tilts.size() && !falls(part.end)) ++part.end;
  return part;
}

std::vector<double> magnitudes(std::span<const double> tilts, const SeriesPart& part) {
  std::vector<double> found;
  for (const double tilt : tilts.subspan(part.first, part.size())) found.push_back(std::abs(tilt));
  return found;
}

bool slopes_backwards(std::span<const double> tilts, const SeriesPart& part) {
  return part.size() > 0 && tilts[part.end - 1] < 0.0;
}

bool has_side(const Quantity& quantity) {
  return quantity.member == QuantityMember(&FrameRecord::sigma_t_over_n) ||
         quantity.member == QuantityMember(&FrameRecord::texture_axis);
}

double number_on_one_side(const Quantity& quantity, const FrameRecord& frame, std::size_t f,
                          bool mirrored_slope) {
  return (mirrored_slope && has_side(quantity) ? -1.0 : 1.0) * number_of(quantity, frame, f);
}

FramesOfRise last_rise(std::span<const FrameRecord> frames) {
  std::vector<double> tilts;
  for (const FrameRecord& frame : frames) tilts.push_back(frame.tilt);
  const SeriesPart part = last_rise(tilts);
  FramesOfRise rise{part.first, {}, magnitudes(tilts, part), slopes_backwards(tilts, part)};
  for (const FrameRecord& frame : frames.subspan(part.first, part.size())) rise.frames.push_back(&frame);
  return rise;
}

std::vector<ObservableRow> rows_of_last_rise(std::span<const ObservableRow> rows) {
  std::vector<double> tilts;
  for (const ObservableRow& row : rows) tilts.push_back(at(row, Observable::tilt));
  const SeriesPart part = last_rise(tilts);
  const auto rise_rows = rows.subspan(part.first, part.size());
  std::vector<ObservableRow> rise(rise_rows.begin(), rise_rows.end());
  if (!slopes_backwards(tilts, part)) return rise;
  for (ObservableRow& row : rise)
    for (const Observable field :
         {Observable::tilt, Observable::sigma_t_over_n, Observable::surface_displacement})
      at(row, field) = -at(row, field);
  return rise;
}

}  // namespace talus::analysis
