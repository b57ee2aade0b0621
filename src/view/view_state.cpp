#include "view/view_state.h"

#include <algorithm>
#include <cmath>

namespace talus::view {
namespace {

constexpr double min_share = 0.02;  // minimum width of the new range, as a share of the old one

/// Rounds to hundredths of the power of ten of the range or, on a logarithmic bar, of the value.
double rounded(double value, const BarEnds& bar) {
  const double size = bar.logarithmic ? std::abs(value) : bar.high - bar.low;
  const double decimals = 2.0 - std::floor(std::log10(size));
  const double scale = std::pow(10.0, std::abs(decimals));  // a whole number, so that the division is exact
  return decimals < 0.0 ? scale * std::round(value / scale) : std::round(value * scale) / scale;
}

constexpr double smallest_part = 3.0;  // D, shortest part that may fill the width of a picture

/// Returns the maximum of a cos(turn) + b sin(turn) over 0 <= turn <= turn_max: the space of the turned part.
double largest_extent(double a, double b, double turn_max) {
  const double turn = std::clamp(std::atan2(b, a), 0.0, turn_max);
  return a * std::cos(turn) + b * std::sin(turn);
}

/// Returns the ratio of depth to length of the part that fills a picture of that aspect. If the part is
/// turned, a picture can be so wide or so high that no part fills it.
double shape_of(double aspect, double turn_max) {
  if (turn_max == 0.0) return 1.0 / aspect;
  double low = 1e-3, high = 1e3;  // bounds of the shape, over which the aspect decreases
  for (int k = 0; k < 60; ++k) {
    const double middle = std::sqrt(low * high);
    (picture_aspect(middle, turn_max) > aspect ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

/// Returns the beginning of a stretch around `centre` that extends beyond [low, high] only as far as it must.
double begin_of(double centre, double stretch, double low, double high) {
  if (stretch >= high - low) return 0.5 * (low + high - stretch);
  return std::clamp(centre - 0.5 * stretch, low, high - stretch);
}

}  // namespace

double value_at(const BarEnds& bar, double share) {
  if (bar.logarithmic) return bar.low * std::pow(bar.high / bar.low, share);
  return bar.low + share * (bar.high - bar.low);
}

std::array<double, 2> pulled(const HeldBar& held, double share) {
  double low = 0.0, high = 1.0;  // as shares of the previous bar
  if (held.part == HeldBar::Part::low) low = std::min(share, 1.0 - min_share);
  if (held.part == HeldBar::Part::high) high = std::max(1.0 + share, min_share);
  if (held.part == HeldBar::Part::middle) {
    low = -share;
    high = 1.0 - share;
  }
  const BarEnds& bar = held.before;
  return {low == 0.0 ? bar.low : rounded(value_at(bar, low), bar),
          high == 1.0 ? bar.high : rounded(value_at(bar, high), bar)};
}

double picture_aspect(double depth, double turn_max) {
  return largest_extent(1.0, depth, turn_max) / largest_extent(depth, 1.0, turn_max);
}

ViewCamera clamped(const ViewCamera& camera, const pictures::MapExtent& bed, double mean_diameter) {
  const double largest_zoom = std::max(1.0, (bed.x_max - bed.x_min) / (smallest_part * mean_diameter));
  return {std::clamp(camera.centre_x, bed.x_min, bed.x_max),
          std::clamp(camera.centre_y, bed.y_min, bed.y_max), std::clamp(camera.zoom, 1.0, largest_zoom)};
}

pictures::MapExtent shown_part(const ViewCamera& camera, const pictures::MapExtent& bed, double mean_diameter,
                               double aspect, double turn_max) {
  const ViewCamera clamped_camera = clamped(camera, bed, mean_diameter);
  const double shape = shape_of(aspect, turn_max);
  const double length =
      std::max(bed.x_max - bed.x_min, (bed.y_max - bed.y_min) / shape) / clamped_camera.zoom;
  const double depth = length * shape;
  const double x = begin_of(clamped_camera.centre_x, length, bed.x_min, bed.x_max);
  const double y = begin_of(clamped_camera.centre_y, depth, bed.y_min, bed.y_max);
  return {x, x + length, y, y + depth};
}

ViewCamera centred(const ViewCamera& camera, const pictures::MapExtent& part) {
  return {0.5 * (part.x_min + part.x_max), 0.5 * (part.y_min + part.y_max), camera.zoom};
}

pictures::MapExtent common_part(const pictures::MapExtent& one, const pictures::MapExtent& other) {
  return {std::max(one.x_min, other.x_min), std::min(one.x_max, other.x_max),
          std::max(one.y_min, other.y_min), std::min(one.y_max, other.y_max)};
}

Theme theme_of(std::string_view name) {
  return static_cast<Theme>(std::ranges::find(theme_names, name) - theme_names.begin());
}

}  // namespace talus::view
