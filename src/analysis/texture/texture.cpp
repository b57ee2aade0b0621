#include "analysis/texture/texture.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/trigonometry.h"
#include "stress/stress.h"

namespace talus::analysis {

namespace {

constexpr int half_turn = 180;  // deg

/// Maps an angle from [-period, period] to [0, period).
double wrapped(double angle, double period) {
  const double turned = angle < 0.0 ? angle + period : angle;
  return turned < period ? turned : turned - period;
}

double direction_of_normal(const FrameContacts& contacts, Index c) {
  return wrapped(degrees(std::atan2(contacts.ny[c], contacts.nx[c])), half_turn);
}

/// Returns n^m, the unit vector at m times the angle of n.
std::complex<double> power(std::complex<double> n, int m) {
  std::complex<double> product = 1.0;
  for (int k = 0; k < m; ++k) product *= n;
  return product;
}

/// Returns the number of contacts at each degree of direction, smoothed with a period of 180 deg.
std::vector<double> smoothed_directions(const FrameContacts& contacts) {
  constexpr double standard_deviation = 5.0;  // deg
  constexpr int reach = 20;                   // deg, four standard deviations
  std::vector<double> smooth(half_turn, 0.0);
  std::vector<int> number(half_turn, 0);
  for (Index c = 0; c < contacts.count(); ++c)
    ++number[static_cast<std::size_t>(std::lround(direction_of_normal(contacts, c))) % half_turn];
  for (int k = -reach; k <= reach; ++k) {
    const double weight = std::exp(-0.5 * k * k / (standard_deviation * standard_deviation));
    for (int at = 0; at < half_turn; ++at) smooth[at] += weight * number[(at + k + half_turn) % half_turn];
  }
  return smooth;
}

}  // namespace

Histogram normal_directions(const Frame& frame, int bins, bool weighted_by_force) {
  Histogram histogram(0.0, half_turn, bins);
  for (Index c = 0; c < frame.contacts.count(); ++c)
    histogram.add(direction_of_normal(frame.contacts, c), weighted_by_force ? frame.contacts.fn[c] : 1.0);
  return histogram;
}

FabricComponent fabric_component(const FrameContacts& contacts, int m, const std::vector<double>& weights) {
  double cosines = 0.0, sines = 0.0, total = 0.0;
  for (Index c = 0; c < contacts.count(); ++c) {
    const std::complex<double> turned = power({contacts.nx[c], contacts.ny[c]}, m);
    const double weight = weights.empty() ? 1.0 : weights[c];
    cosines += weight * turned.real();
    sines += weight * turned.imag();
    total += weight;
  }
  if (!(total > 0.0)) return {not_known, not_known};
  return {2.0 * std::hypot(cosines, sines) / total,
          wrapped(degrees(std::atan2(sines, cosines)) / m, 360.0 / m)};
}

std::array<double, 3> direction_peaks(const Frame& frame) {
  if (frame.contacts.count() == 0) return {not_known, not_known, not_known};
  const std::vector<double> smooth = smoothed_directions(frame.contacts);
  std::array<double, 3> peaks = {0.0, 60.0, 120.0};
  for (double& peak : peaks) {
    const int centre = static_cast<int>(peak);
    double highest = -1.0;
    for (int at = centre - 29; at <= centre + 30; ++at)
      if (const double here = smooth[(at + half_turn) % half_turn]; here > highest) {
        highest = here;
        peak = at;
      }
  }
  return peaks;
}

namespace {

/// Returns the direction of the major principal stress of the contact forces, rad; NaN without contacts.
double stress_axis(const BedFrame& bed) {
  Tensor2 sum;
  for (Index c = 0; c < bed.frame.contacts.count(); ++c) add_moment(bed, c, sum);
  return bed.frame.contacts.count() > 0 ? stress::stress_state(sum).axis : not_known;
}

}  // namespace

void measure_texture(const BedFrame& bed, FrameRecord& record) {
  const FrameContacts& contacts = bed.frame.contacts;
  record.texture_axis = stress_axis(bed);
  const double axis_x = std::cos(2.0 * record.texture_axis), axis_y = std::sin(2.0 * record.texture_axis);
  double cosines = 0.0, forces = 0.0, force_cosines = 0.0, friction_sines = 0.0, lengths = 0.0,
         length_cosines = 0.0;
  for (Index c = 0; c < contacts.count(); ++c) {
    const double nx = contacts.nx[c], ny = contacts.ny[c];
    const double x = nx * nx - ny * ny, y = 2.0 * nx * ny;  // unit vector at twice the angle of the normal
    const double cosine = x * axis_x + y * axis_y;          // cosine and sine of twice the angle to the axis
    const double sine = y * axis_x - x * axis_y;
    const double length = branch_length(bed, c);
    cosines += cosine;
    forces += contacts.fn[c];
    force_cosines += contacts.fn[c] * cosine;
    friction_sines += contacts.ft[c] * sine;
    lengths += length;
    length_cosines += length * cosine;
  }
  record.texture_contacts = 2.0 * cosines / contacts.count();
  record.texture_normal_forces = 2.0 * force_cosines / forces - record.texture_contacts;
  record.texture_tangential_forces = -2.0 * friction_sines / forces;
  record.texture_branches = 2.0 * length_cosines / lengths - record.texture_contacts;
  // Gamma to first order in the anisotropies.
  record.texture_stress_ratio = 0.5 * (record.texture_contacts + record.texture_normal_forces +
                                       record.texture_tangential_forces + record.texture_branches);
}

}  // namespace talus::analysis
