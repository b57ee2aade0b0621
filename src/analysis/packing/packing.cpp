#include "analysis/packing/packing.h"

#include <algorithm>
#include <cmath>

#include "analysis/free_grains.h"
#include "core/tensor.h"
#include "core/trigonometry.h"
#include "stress/free_surface.h"
#include "stress/internal_moment.h"

namespace talus::analysis {
namespace {

Tensor2 over(const Tensor2& moment, double volume) {
  return tensor(matrix(moment) / volume);  // (T20)
}

/// Returns the area of a disk below a height measured from its centre, m^2.
double area_below(double height, double radius) {
  const double u = std::clamp(height / radius, -1.0, 1.0);
  return radius * radius * (0.5 * pi + u * std::sqrt(1.0 - u * u) + std::asin(u));
}

}  // namespace

double frame_volume(const BedFrame& bed) {
  Grains grains;
  grains.free_count = bed.statics.free_count;
  grains.x = bed.frame.x;
  grains.y = bed.frame.y;
  grains.radius = bed.statics.radius;
  Boundary boundary;
  boundary.periodic = bed.statics.periodic;
  boundary.length = bed.statics.length;
  return stress::bed_volume(grains, boundary);
}

double bulk_solid_fraction(const BedFrame& bed, double volume) {
  const double low = bulk_margin * bed.statics.mean_diameter;
  const double high = volume / bed.statics.length - low;
  if (!(high > low)) return not_known;
  double area = 0.0;
  for (Index i = 0; i < bed.statics.free_count; ++i)
    area += area_below(high - bed.frame.y[i], bed.statics.radius[i]) -
            area_below(low - bed.frame.y[i], bed.statics.radius[i]);
  return area / (bed.statics.length * (high - low));
}

PackingStress packing_stress(const BedFrame& bed, double volume) {
  PackingStress stress;
  stress.sigma = over(stress::sum_of_moments(bed.frame.internal_moment, 0, bed.statics.free_count), volume);
  stress.state = stress::stress_state(stress.sigma);
  stress.normal = stress.sigma.yy;
  stress.shear = -stress.sigma.yx;
  stress.shear_over_normal = stress.shear / stress.normal;
  return stress;
}

std::vector<Tensor2> section_stresses(const BedFrame& bed, double volume, int count) {
  std::vector<Tensor2> sections(static_cast<std::size_t>(count));
  for (Index i = 0; i < bed.statics.free_count; ++i) {
    // Rounding may place a centre exactly at the end of the bed.
    const auto section = static_cast<int>(std::floor(bed.frame.x[i] / bed.statics.length * count));
    add_to(sections[static_cast<std::size_t>(std::clamp(section, 0, count - 1))],
           bed.frame.internal_moment[i]);
  }
  for (Tensor2& section : sections) section = over(section, volume / count);
  return sections;
}

Histogram stress_ratio_distribution(const BedFrame& bed, int bins) {
  Histogram histogram(0.0, 1.0, bins);
  for (double gamma : free_grain_values(bed.frame.gamma, bed.statics)) histogram.add(gamma);
  return histogram;
}

}  // namespace talus::analysis
