#include "studies/measured_values.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "analysis/failure/failure_ratio.h"
#include "core/trigonometry.h"
#include "studies/wall_fit.h"

namespace talus::studies {
namespace {

using enum PaperQuantity;

/// A run that has failed.
struct FailedRun {
  const runs::RunView& run;
  analysis::FramesOfRise rise;
  std::size_t at_theta_c;  ///< last frame at or before theta_c

  const analysis::FrameRecord& frame(std::size_t k) const { return *rise.frames.at(k); }
  double tilt(std::size_t k) const { return rise.tilts.at(k); }
  std::size_t frame_at(double theta) const {
    return analysis::frame_not_after(rise.tilts, theta).value_or(0);
  }
};

FailedRun failed_run(const runs::RunView& run) {
  FailedRun failure{run, analysis::last_rise(run.analysis.frames), 0};
  failure.at_theta_c = failure.frame_at(run.analysis.theta_c);
  return failure;
}

/// Returns the mean of `value(frame)` over the frames within half a degree before theta_c.
template <typename Value>
double mean_before_failure(const FailedRun& failure, const Value& value) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k <= failure.at_theta_c; ++k) {
    if (k < failure.at_theta_c &&
        failure.tilt(k) < failure.run.analysis.theta_c - radians(analysis::failure_window))
      continue;
    sum += value(k);
    ++count;
  }
  return sum / count;
}

double stress_ratio(const FailedRun& failure) {
  return mean_before_failure(
      failure, [&](std::size_t k) { return failure.frame(k).stress_ratio / std::sin(failure.tilt(k)); });
}

/// Difference of sigma_xx between the lower and the upper half of the bed, over their mean.
double gradient(const FailedRun& failure) {
  return mean_before_failure(failure, [&](std::size_t k) {
    const std::vector<double>& sections = failure.frame(k).section_sigma_xx;
    const auto half = static_cast<std::ptrdiff_t>(sections.size() / 2);
    const double upper = std::accumulate(sections.begin(), sections.begin() + half, 0.0);
    const double lower = std::accumulate(sections.end() - half, sections.end(), 0.0);
    return 2.0 * (lower - upper) / (lower + upper);
  });
}

/// Onset of dilation, and the contraction before it. The range of the minimum of the strain says
/// whether either is more than noise.
double contracted(const FailedRun& failure) {
  const double onset = failure.run.analysis.dilation[0];
  if (std::isnan(onset)) return -failure.frame(failure.at_theta_c).volume_strain;
  if (failure.run.analysis.dilation_low[0] <= failure.tilt(0) + analysis::same_tilt) return not_known;
  return -failure.frame(failure.frame_at(onset)).volume_strain;
}

double dilated(const FailedRun& failure) {
  const double onset = failure.run.analysis.dilation[0];
  if (std::isnan(onset)) return not_known;
  return failure.frame(failure.at_theta_c).volume_strain -
         failure.frame(failure.frame_at(onset)).volume_strain;
}

/// Returns the onset of dilation or, if its range begins at the first tilt, the end of this range as an upper
/// bound.
MeasuredValue dilation_tilt(const FailedRun& failure) {
  if (failure.run.analysis.dilation_low[0] <= failure.tilt(0) + analysis::same_tilt)
    return {degrees(failure.run.analysis.dilation_high[0]), true};
  return {degrees(failure.run.analysis.dilation[0])};
}

double peak(const FailedRun& failure, std::size_t which) {
  return degrees(failure.frame(0).direction_peak[which]);
}

/// Maps a direction near 180 deg to one near 0.
double wrapped(double angle) { return angle > 90.0 ? angle - 180.0 : angle; }

/// Measures a quantity that combines several numbers of the run; empty for all others.
std::optional<MeasuredValue> derived(const FailedRun& failure, PaperQuantity quantity) {
  switch (quantity) {
    case normals_near_0:
      return MeasuredValue{wrapped(peak(failure, 0))};
    case normals_near_60:
      return MeasuredValue{peak(failure, 1)};
    case normals_near_120:
      return MeasuredValue{peak(failure, 2)};
    case stress_ratio_over_sine:
      return MeasuredValue{stress_ratio(failure)};
    case contraction:
      return MeasuredValue{contracted(failure)};
    case dilation:
      return MeasuredValue{dilated(failure)};
    case theta_d_by_dilation:
      return dilation_tilt(failure);
    case wall_gradient:
      return MeasuredValue{gradient(failure)};
    case wall_coefficient:
      return MeasuredValue{not_known};
    default:
      return std::nullopt;
  }
}

}  // namespace

MeasuredValue measure(const runs::RunView& run, PaperQuantity quantity, std::size_t factor,
                      Population population) {
  using analysis::FrameThreshold;
  if (std::isnan(run.analysis.theta_c)) return {not_known};
  if (const auto found = derived(failed_run(run), quantity)) return *found;
  analysis::NumberOfRun number = {paper_value(quantity).source, paper_value(quantity).place};
  const bool of_all = population == Population::all;
  if (of_all && number.quantity == analysis::QuantityMember(&FrameThreshold::overloaded_fraction))
    number.quantity = &FrameThreshold::overloaded_fraction_of_all;
  const analysis::Quantity& row = analysis::quantity_of(number.quantity);
  const std::size_t f = analysis::needs_threshold(row) ? factor : 0;
  const double value =
      analysis::scaled(row.unit, analysis::number_at(run.analysis, number, f), run.statics.mean_diameter);
  if (std::isnan(value)) return {not_known};
  // Values beyond the cut of the paper's data processing are unknown in the paper.
  if (quantity == lc_max_after_jump) return {std::min(value, paper_lc_cut)};
  const bool at_percolation = quantity == theta_d_by_percolation || quantity == overloaded_at_percolation;
  return {value, at_percolation && std::isnan(run.analysis.thresholds[f].percolation_error)};
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
  const double volume =
      analysis::number_at(run.analysis, {&analysis::FrameRecord::volume, analysis::Place::theta_c});
  return {volume / (run.statics.length * run.statics.length), ratio};
}

}  // namespace talus::studies
