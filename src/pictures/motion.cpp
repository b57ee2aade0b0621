#include "pictures/motion.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/text.h"
#include "core/trigonometry.h"
#include "pictures/layers.h"
#include "pictures/texts.h"

namespace talus::pictures {
namespace {

/// Rounds to two digits, as printed in bars and legends.
double rounded(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::round(value / unit) * unit;
}

/// Returns nothing if nothing has moved. The lowest grains hardly move, so the scale covers at most five
/// decades; it is a valid range even if all move alike.
std::optional<ScaleRange> size_range(const LogHistogram& moved) {
  constexpr double most = 1e5, least = 2.0;  // ratio of the upper end to the lower one
  const double high = moved.quantile(size_shares.high);
  if (!(high > 0.0)) return std::nullopt;
  const double low = std::clamp(moved.quantile(size_shares.low), high / most, high / least);
  return ScaleRange{rounded(low), rounded(high)};
}

std::optional<ScaleRange> signed_range(const LogHistogram& turned) {
  const double largest = turned.quantile(signed_share);
  if (!(largest > 0.0)) return std::nullopt;
  return ScaleRange{-rounded(largest), rounded(largest)};
}

}  // namespace

MotionSpan motion_span(const MapFrame& bed) {
  const double begin = bed.reference != nullptr ? bed.reference->tilt : bed.frame.tilt;
  const double tilted = degrees(bed.frame.tilt - begin);
  // During the flow after failure the bed is not tilted, so there is nothing to divide by.
  const bool moved = bed.reference != nullptr && bed.reference->step != bed.frame.step;
  if (bed.per_degree && (tilted > 0.0 || !moved))
    return {true, tilted > 0.0 ? tilted : 1.0, " per degree of tilt", " per degree"};
  return {false, 1.0, fmt::format(" since {}°", degrees_text(begin, 2)), ""};
}

void LogHistogram::add(double value) {
  const double at =
      value >= smallest_ ? 1.0 + std::floor(classes_per_decade * std::log10(value / smallest_)) : 0.0;
  ++counts_[static_cast<std::size_t>(std::min(at, static_cast<double>(counts_.size() - 1)))];
  ++total_;
}

double LogHistogram::quantile(double share) const {
  const double wanted = share * static_cast<double>(total_);
  std::int64_t below = counts_[0];
  std::size_t k = 0;
  while (k + 1 < counts_.size() && static_cast<double>(below) < wanted) below += counts_[++k];
  if (k == 0) return 0.0;
  return smallest_ * std::pow(10.0, static_cast<double>(k) / classes_per_decade);
}

MotionSample::MotionSample(const MapLayers& maps, const MapSettings& settings) : settings_(settings) {
  constexpr double smallest_temperature = 1e-18;  // square of the smallest speed
  for (const MapKind kind : maps) {
    const LogHistogram none =
        kind == MapKind::temperature ? LogHistogram(smallest_temperature) : LogHistogram();
    sizes_.try_emplace(kind, std::array{none, none});
  }
}

void MotionSample::add(const MapFrame& bed) {
  const MotionSpan span = motion_span(bed);
  for (auto& [kind, sizes] : sizes_) {
    const bool moving = needs_reference(kind);
    if (moving && bed.reference == nullptr) continue;
    for (const double value : map_values(kind, bed, settings_))
      if (!std::isnan(value)) sizes[moving && span.per_degree].add(std::abs(value));
  }
}

MotionRanges MotionSample::ranges() const {
  MotionRanges ranges;
  for (const auto& [kind, sizes] : sizes_)
    for (std::size_t per_degree = 0; per_degree < sizes.size(); ++per_degree)
      ranges.fitting[kind][per_degree] =
          is_signed(kind) ? signed_range(sizes[per_degree]) : size_range(sizes[per_degree]);
  return ranges;
}

}  // namespace talus::pictures
