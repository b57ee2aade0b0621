#include "reproduction/measured_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "core/trigonometry.h"
#include "figures/wall_figures.h"

namespace talus {
namespace {

using enum PaperQuantity;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double same_tilt = 1e-9;      // rad: tilts are multiples of a step up to rounding
constexpr double failure_window = 0.5;  // deg before theta_c

/// A run with its angles looked up: frames by index, where there are any.
struct Reader {
  const MeasuredRun& run;
  std::size_t factor;
  double theta_c;                   // rad
  std::size_t at_theta_c;           // the last frame up to it
  std::optional<std::size_t> jump;  // the frame after the jump of l_c max

  double scalar(const char* name, std::size_t index = 0) const {
    return values<double>(run.analysis, name)[index];
  }
  double series(const char* name, std::size_t frame, std::size_t column = 0) const {
    return row<double>(run.analysis, name, frame)[column];
  }
  double threshold_series(const char* name, std::size_t frame) const { return series(name, frame, factor); }
  double length(const char* name, std::size_t frame) const {
    return threshold_series(name, frame) / run.mean_diameter;
  }
  /// The last frame not after a tilt.
  std::size_t frame_at(double tilt) const {
    const auto after = std::ranges::upper_bound(run.tilts, tilt + same_tilt);
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - run.tilts.begin() - 1, 0));
  }
};

/// Mean of `value(frame)` over the frames of the last half degree up to theta_c.
template <typename Value>
double mean_before_failure(const Reader& reader, const Value& value) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k <= reader.at_theta_c; ++k) {
    if (k < reader.at_theta_c && reader.run.tilts[k] < reader.theta_c - radians(failure_window)) continue;
    sum += value(k);
    ++count;
  }
  return sum / count;
}

double stress_ratio(const Reader& reader) {
  return mean_before_failure(reader, [&](std::size_t k) {
    return reader.series("packing/stress_ratio", k) / std::sin(reader.run.tilts[k]);
  });
}

/// Of sigma_xx between the lower and the upper half of the bed, over their mean.
double gradient(const Reader& reader) {
  return mean_before_failure(reader, [&](std::size_t k) {
    const auto sections = row<double>(reader.run.analysis, "sections/sigma_xx", k);
    const auto half = static_cast<std::ptrdiff_t>(sections.size() / 2);
    const double upper = std::accumulate(sections.begin(), sections.begin() + half, 0.0);
    const double lower = std::accumulate(sections.end() - half, sections.end(), 0.0);
    return 2.0 * (lower - upper) / (lower + upper);
  });
}

/// Where the bed dilates, and how much it contracted before. The range of the minimum of the strain says
/// whether either is more than noise.
double contracted(const Reader& reader) {
  const double onset = reader.scalar("theta_d/dilation");
  if (std::isnan(onset)) return -reader.series("packing/volume_strain", reader.at_theta_c);
  if (reader.scalar("theta_d/dilation_low") <= reader.run.tilts.front() + same_tilt) return none;
  return -reader.series("packing/volume_strain", reader.frame_at(onset));
}

double dilated(const Reader& reader) {
  const double onset = reader.scalar("theta_d/dilation");
  if (std::isnan(onset)) return none;
  return reader.series("packing/volume_strain", reader.at_theta_c) -
         reader.series("packing/volume_strain", reader.frame_at(onset));
}

/// The onset of dilation; where its range begins at the first tilt, the end of this range as an upper bound.
Measured dilation_tilt(const Reader& reader) {
  if (reader.scalar("theta_d/dilation_low") <= reader.run.tilts.front() + same_tilt)
    return {degrees(reader.scalar("theta_d/dilation_high")), true};
  return {degrees(reader.scalar("theta_d/dilation"))};
}

/// `value(frame)` where overloaded grains begin to percolate.
template <typename Value>
Measured at_percolation(const Reader& reader, const Value& value) {
  const double onset = reader.scalar("theta_d/percolation", reader.factor);
  if (std::isnan(onset)) return {none, false};
  return {value(reader.frame_at(onset)),
          std::isnan(reader.scalar("theta_d/percolation_error", reader.factor))};
}

double peak(const Reader& reader, std::size_t which) {
  return degrees(reader.series("contacts/direction_peak", 0, which));
}

/// A direction near 180 deg is one near 0.
double wrapped(double angle) { return angle > 90.0 ? angle - 180.0 : angle; }

Measured measure_packing(const Reader& reader, PaperQuantity quantity) {
  switch (quantity) {
    case solid_fraction:
      return {reader.series("packing/solid_fraction", 0)};
    case coordination_number:
      return {reader.series("contacts/coordination_number", 0)};
    case normals_near_0:
      return {wrapped(peak(reader, 0))};
    case normals_near_60:
      return {peak(reader, 1)};
    case normals_near_120:
      return {peak(reader, 2)};
    case stress_ratio_at_0:
      return {reader.series("packing/stress_ratio", 0)};
    case theta_c:
    case theta_c_of_walls:
      return {degrees(reader.theta_c)};
    case shear_over_tangent:
    case shear_over_tangent_of_walls:
      return {ratio_at_failure(reader.run.rows, reader.theta_c, failure_window).mean};
    case stress_ratio_over_sine:
      return {stress_ratio(reader)};
    case contraction:
      return {contracted(reader)};
    case dilation:
      return {dilated(reader)};
    case volume_strain_at_theta_c:
      return {reader.series("packing/volume_strain", reader.at_theta_c)};
    case theta_d_by_dilation:
      return dilation_tilt(reader);
    case wall_gradient:
      return {gradient(reader)};
    default:
      return {none};
  }
}

Measured measure_chain(const Reader& reader, PaperQuantity quantity, Population population) {
  const char* fraction = population == Population::all ? "overloaded/fraction_of_all" : "overloaded/fraction";
  const auto overloaded = [&](std::size_t k) { return reader.threshold_series(fraction, k); };
  const auto at_jump = [&](const auto& value) { return Measured{reader.jump ? value(*reader.jump) : none}; };
  switch (quantity) {
    case overloaded_at_0:
      return {overloaded(0)};
    case overloaded_at_theta_d:
      return at_jump(overloaded);
    case overloaded_at_theta_c:
      return {overloaded(reader.at_theta_c)};
    case overloaded_at_percolation:
      return at_percolation(reader, overloaded);
    case lc_mean_at_0:
      return {reader.length("lc/mean", 0)};
    case lc_mean_at_theta_d:
      return at_jump([&](std::size_t k) { return reader.length("lc/mean", k); });
    case lc_mean_at_theta_c:
      return {reader.length("lc/mean", reader.at_theta_c)};
    case lc_max_at_0:
      return {reader.length("lc/max", 0)};
    case lc_max_before_jump:
      return at_jump([&](std::size_t k) { return reader.length("lc/max", k - 1); });
    case lc_max_after_jump:
      // What lies beyond the cut of the paper's data processing is not known to the paper.
      return at_jump([&](std::size_t k) { return std::min(reader.length("lc/max", k), paper_lc_cut); });
    case theta_d_by_jump:
      return {degrees(reader.scalar("theta_d/lc_jump", reader.factor))};
    case theta_d_by_percolation:
      return at_percolation(reader, [&](std::size_t k) { return degrees(reader.run.tilts[k]); });
    default:
      return {none};
  }
}

Reader read(const MeasuredRun& run, std::size_t factor) {
  Reader reader{run, factor, values<double>(run.analysis, "theta_c")[0], 0, {}};
  if (std::isnan(reader.theta_c)) return reader;
  reader.at_theta_c = reader.frame_at(reader.theta_c);
  if (factor >= run.analysis.sizes.at('F')) return reader;
  if (const double jump = reader.scalar("theta_d/lc_jump", factor); !std::isnan(jump))
    reader.jump = reader.frame_at(jump);
  return reader;
}

bool needs_threshold(PaperQuantity quantity) {
  return quantity >= overloaded_at_0 && quantity < theta_d_by_dilation;
}

}  // namespace

Measured measure(const MeasuredRun& run, PaperQuantity quantity, std::size_t factor, Population population) {
  const Reader reader = read(run, factor);
  if (std::isnan(reader.theta_c)) return {none};
  if (!needs_threshold(quantity)) return measure_packing(reader, quantity);
  if (factor >= run.analysis.sizes.at('F')) return {none};
  return measure_chain(reader, quantity, population);
}

MeasuredValues measure_all(const MeasuredRun& run, std::size_t factor, Population population) {
  MeasuredValues all{};
  for (std::size_t q = 0; q < quantity_count; ++q)
    all[q] = measure(run, static_cast<PaperQuantity>(q), factor, population);
  return all;
}

WallPoint wall_point(const MeasuredRun& run, double length) {
  const double ratio = measure(run, shear_over_tangent_of_walls, 0, Population::carrying).value;
  if (std::isnan(ratio)) return {none, none};
  const Reader reader = read(run, 0);
  return {reader.series("packing/volume", reader.at_theta_c) / (length * length), ratio};
}

}  // namespace talus
