#include "ensemble/measured_values.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "analysis/failure/failure_ratio.h"
#include "core/trigonometry.h"
#include "ensemble/wall_fit.h"

namespace talus::ensemble {
namespace {

using enum PaperQuantity;

constexpr double same_tilt = 1e-9;  // rad: tilts are multiples of a step up to rounding

/// A run with its angles looked up: frames by index, where there are any.
struct RunAtThreshold {
  const runs::RunView& run;
  std::size_t factor;
  double theta_c;                   // rad
  std::size_t at_theta_c;           // the last frame up to it
  std::optional<std::size_t> jump;  // the frame after the jump of l_c max

  const analysis::FrameRecord& frame(std::size_t k) const { return run.analysis.frames.at(k); }
  const analysis::FrameThreshold& overload(std::size_t k) const { return frame(k).thresholds.at(factor); }
  const analysis::RunThreshold& threshold() const { return run.analysis.thresholds.at(factor); }
  double length(std::size_t k, double analysis::FrameThreshold::*member) const {
    return overload(k).*member / run.statics.mean_diameter;
  }
  /// The last frame not after a tilt.
  std::size_t frame_at(double tilt) const {
    const std::vector<analysis::FrameRecord>& frames = run.analysis.frames;
    const auto after = std::ranges::upper_bound(frames, tilt + same_tilt, {}, &analysis::FrameRecord::tilt);
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - frames.begin() - 1, 0));
  }
};

/// Mean of `value(frame)` over the frames of the last half degree up to theta_c.
template <typename Value>
double mean_before_failure(const RunAtThreshold& of, const Value& value) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k <= of.at_theta_c; ++k) {
    if (k < of.at_theta_c && of.frame(k).tilt < of.theta_c - radians(analysis::failure_window)) continue;
    sum += value(k);
    ++count;
  }
  return sum / count;
}

double stress_ratio(const RunAtThreshold& of) {
  return mean_before_failure(
      of, [&](std::size_t k) { return of.frame(k).stress_ratio / std::sin(of.frame(k).tilt); });
}

/// Of sigma_xx between the lower and the upper half of the bed, over their mean.
double gradient(const RunAtThreshold& of) {
  return mean_before_failure(of, [&](std::size_t k) {
    const std::vector<double>& sections = of.frame(k).section_sigma_xx;
    const auto half = static_cast<std::ptrdiff_t>(sections.size() / 2);
    const double upper = std::accumulate(sections.begin(), sections.begin() + half, 0.0);
    const double lower = std::accumulate(sections.end() - half, sections.end(), 0.0);
    return 2.0 * (lower - upper) / (lower + upper);
  });
}

/// Where the bed dilates, and how much it contracted before. The range of the minimum of the strain says
/// whether either is more than noise.
double contracted(const RunAtThreshold& of) {
  const double onset = of.run.analysis.dilation[0];
  if (std::isnan(onset)) return -of.frame(of.at_theta_c).volume_strain;
  if (of.run.analysis.dilation_low[0] <= of.frame(0).tilt + same_tilt) return not_known;
  return -of.frame(of.frame_at(onset)).volume_strain;
}

double dilated(const RunAtThreshold& of) {
  const double onset = of.run.analysis.dilation[0];
  if (std::isnan(onset)) return not_known;
  return of.frame(of.at_theta_c).volume_strain - of.frame(of.frame_at(onset)).volume_strain;
}

/// The onset of dilation; where its range begins at the first tilt, the end of this range as an upper bound.
Measured dilation_tilt(const RunAtThreshold& of) {
  if (of.run.analysis.dilation_low[0] <= of.frame(0).tilt + same_tilt)
    return {degrees(of.run.analysis.dilation_high[0]), true};
  return {degrees(of.run.analysis.dilation[0])};
}

/// `value(frame)` where overloaded grains begin to percolate.
template <typename Value>
Measured at_percolation(const RunAtThreshold& of, const Value& value) {
  const double onset = of.threshold().percolation;
  if (std::isnan(onset)) return {not_known, false};
  return {value(of.frame_at(onset)), std::isnan(of.threshold().percolation_error)};
}

double peak(const RunAtThreshold& of, std::size_t which) {
  return degrees(of.frame(0).direction_peak[which]);
}

/// A direction near 180 deg is one near 0.
double wrapped(double angle) { return angle > 90.0 ? angle - 180.0 : angle; }

Measured measure_packing(const RunAtThreshold& of, PaperQuantity quantity) {
  switch (quantity) {
    case solid_fraction:
      return {of.frame(0).solid_fraction};
    case coordination_number:
      return {of.frame(0).coordination_number};
    case normals_near_0:
      return {wrapped(peak(of, 0))};
    case normals_near_60:
      return {peak(of, 1)};
    case normals_near_120:
      return {peak(of, 2)};
    case stress_ratio_at_0:
      return {of.frame(0).stress_ratio};
    case theta_c:
    case theta_c_of_walls:
      return {degrees(of.theta_c)};
    case shear_over_tangent:
    case shear_over_tangent_of_walls:
      return {of.run.analysis.failure_ratio};
    case stress_ratio_over_sine:
      return {stress_ratio(of)};
    case contraction:
      return {contracted(of)};
    case dilation:
      return {dilated(of)};
    case volume_strain_at_theta_c:
      return {of.frame(of.at_theta_c).volume_strain};
    case theta_d_by_dilation:
      return dilation_tilt(of);
    case wall_gradient:
      return {gradient(of)};
    default:
      return {not_known};
  }
}

Measured measure_chain(const RunAtThreshold& of, PaperQuantity quantity, Population population) {
  const auto fraction = population == Population::all ? &analysis::FrameThreshold::overloaded_fraction_of_all
                                                      : &analysis::FrameThreshold::overloaded_fraction;
  const auto overloaded = [&](std::size_t k) { return of.overload(k).*fraction; };
  const auto at_jump = [&](const auto& value) { return Measured{of.jump ? value(*of.jump) : not_known}; };
  switch (quantity) {
    case overloaded_at_0:
      return {overloaded(0)};
    case overloaded_at_theta_d:
      return at_jump(overloaded);
    case overloaded_at_theta_c:
      return {overloaded(of.at_theta_c)};
    case overloaded_at_percolation:
      return at_percolation(of, overloaded);
    case lc_mean_at_0:
      return {of.length(0, &analysis::FrameThreshold::lc_mean)};
    case lc_mean_at_theta_d:
      return at_jump([&](std::size_t k) { return of.length(k, &analysis::FrameThreshold::lc_mean); });
    case lc_mean_at_theta_c:
      return {of.length(of.at_theta_c, &analysis::FrameThreshold::lc_mean)};
    case lc_max_at_0:
      return {of.length(0, &analysis::FrameThreshold::lc_max)};
    case lc_max_before_jump:
      return at_jump([&](std::size_t k) { return of.length(k - 1, &analysis::FrameThreshold::lc_max); });
    case lc_max_after_jump:
      // What lies beyond the cut of the paper's data processing is not known to the paper.
      return at_jump([&](std::size_t k) {
        return std::min(of.length(k, &analysis::FrameThreshold::lc_max), paper_lc_cut);
      });
    case theta_d_by_jump:
      return {degrees(of.threshold().lc_jump)};
    case theta_d_by_percolation:
      return at_percolation(of, [&](std::size_t k) { return degrees(of.frame(k).tilt); });
    default:
      return {not_known};
  }
}

RunAtThreshold at_threshold(const runs::RunView& run, std::size_t factor) {
  RunAtThreshold of{run, factor, run.analysis.theta_c, 0, {}};
  if (std::isnan(of.theta_c)) return of;
  of.at_theta_c = of.frame_at(of.theta_c);
  if (factor >= run.analysis.thresholds.size()) return of;
  if (const double jump = of.threshold().lc_jump; !std::isnan(jump)) of.jump = of.frame_at(jump);
  return of;
}

bool needs_threshold(PaperQuantity quantity) {
  return quantity >= overloaded_at_0 && quantity < theta_d_by_dilation;
}

}  // namespace

Measured measure(const runs::RunView& run, PaperQuantity quantity, std::size_t factor,
                 Population population) {
  const RunAtThreshold of = at_threshold(run, factor);
  if (std::isnan(of.theta_c)) return {not_known};
  if (!needs_threshold(quantity)) return measure_packing(of, quantity);
  if (factor >= run.analysis.thresholds.size()) return {not_known};
  return measure_chain(of, quantity, population);
}

MeasuredValues measure_all(const runs::RunView& run, std::size_t factor, Population population) {
  MeasuredValues all{};
  for (std::size_t q = 0; q < quantity_count; ++q)
    all[q] = measure(run, static_cast<PaperQuantity>(q), factor, population);
  return all;
}

WallPoint wall_point(const runs::RunView& run) {
  const double ratio = measure(run, shear_over_tangent_of_walls, 0, Population::carrying).value;
  if (std::isnan(ratio)) return {not_known, not_known};
  const RunAtThreshold of = at_threshold(run, 0);
  const double length = run.statics.length;
  return {of.frame(of.at_theta_c).volume / (length * length), ratio};
}

}  // namespace talus::ensemble
