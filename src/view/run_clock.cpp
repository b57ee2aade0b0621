#include "view/run_clock.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "analysis/failure/last_rise.h"

namespace talus::view {
namespace {

std::size_t nearest_place(std::span<const double> places, double place) {
  const auto nearest =
      std::ranges::min_element(places, {}, [place](double other) { return std::abs(other - place); });
  return static_cast<std::size_t>(nearest - places.begin());
}

double begin_of(const RunInstants& run) { return run.times.empty() ? 0.0 : run.times.front(); }

/// Returns the time of the last frame of the tilt.
double end_of_tilt(const RunInstants& run) {
  return run.tilt_count > 0 ? run.times[run.tilt_count - 1] : begin_of(run);
}

}  // namespace

std::optional<std::size_t> linked_frame(PlotAxis clock, const RunInstants& shown, const Instant& at,
                                        const RunInstants& other) {
  if (other.tilt_count == 0) return std::nullopt;
  if (clock == PlotAxis::time) return nearest_place(other.times, at.time - begin_of(shown) + begin_of(other));
  const double ahead = clock == PlotAxis::angle_left ? other.theta_c - shown.theta_c : 0.0;
  if (!std::isfinite(ahead)) return std::nullopt;
  if (at.in_flow && other.times.size() > other.tilt_count)
    return other.tilt_count + nearest_place(std::span(other.times).subspan(other.tilt_count),
                                            at.time - end_of_tilt(shown) + end_of_tilt(other));
  const auto tilts = std::span(other.tilts).first(other.tilt_count);
  if (clock == PlotAxis::angle_left)
    return nearest_place(analysis::magnitudes(tilts, {0, tilts.size()}), std::abs(at.tilt) + ahead);
  return nearest_place(tilts, at.tilt);
}

}  // namespace talus::view
