#include "studies/paper_values.h"

namespace talus::studies {
namespace {

using enum PaperQuantity;
using enum Relation;
using analysis::Analysis;
using analysis::FrameRecord;
using analysis::FrameThreshold;
using analysis::Place;
using analysis::RunThreshold;

constexpr double wall_coefficient_value = 2.5;
constexpr double wall_coefficient_accuracy = 0.25;

std::span<const PaperValue> from_to(PaperQuantity first, PaperQuantity end) {
  const auto begin = static_cast<std::size_t>(first);
  return std::span(paper_values).subspan(begin, static_cast<std::size_t>(end) - begin);
}

}  // namespace

const std::array<PaperValue, quantity_count> paper_values = {{
    {solid_fraction, "solid fraction at 0 deg", "Sec. II B", "about 0.8", 0.8, 0.05, "1", equals,
     "area of the free grains over the area below the free surface, first frame",
     &FrameRecord::solid_fraction, Place::start},
    {coordination_number, "coordination number z at 0 deg", "Sec. II B", "about 3.5", 3.5, 0.05, "1", equals,
     "force-carrying contacts per grain that carries force, first frame", &FrameRecord::coordination_number,
     Place::start},
    {normals_near_0, "contact normals concentrate near 0 deg", "Sec. II B", "0 deg", 0.0, 5.0, "deg", equals,
     "peak of their directions within 30 deg, density smoothed over 5 deg, first frame",
     &FrameRecord::direction_peak, Place::start},
    {normals_near_60, "contact normals concentrate near 60 deg", "Sec. II B", "60 deg", 60.0, 5.0, "deg",
     equals, "the same", &FrameRecord::direction_peak, Place::start},
    {normals_near_120, "contact normals concentrate near 120 deg", "Sec. II B", "120 deg", 120.0, 5.0, "deg",
     equals, "the same", &FrameRecord::direction_peak, Place::start},
    {stress_ratio_at_0, "Gamma at 0 deg", "Sec. IV, Fig. 5", "about 0.08", 0.08, 0.005, "1", equals,
     "Q/P of the packing, first frame", &FrameRecord::stress_ratio, Place::start},
    {theta_c, "theta_c", "Sec. IV, Fig. 4", "about 19 to 21 deg, all beds", 20.0, 1.0, "deg", equals,
     "tilt at which the final, sustained flow began", &Analysis::theta_c, Place::run},
    {shear_over_tangent, "sigma_T/sigma_N over tan(theta) at theta_c", "Eq. 10, Fig. 4",
     "1, fits excellently", 1.0, 0.02, "1", equals, "mean over the last half degree up to theta_c",
     &Analysis::failure_ratio, Place::run},
    {stress_ratio_over_sine, "Gamma over sin(theta) at theta_c", "Eq. 11, Fig. 5", "1, fits well", 1.0, 0.05,
     "1", equals, "mean over the last half degree up to theta_c", &FrameRecord::stress_ratio, Place::theta_c},
    {contraction, "contraction up to theta_d", "Sec. VI, Fig. 14", "the volume first decreases", 0.0, 0.0,
     "1", above,
     "V0 less the smallest V, over V0; up to theta_c if no dilation sets in; none if the range of the "
     "minimum begins at the first tilt",
     &FrameRecord::volume_strain, Place::theta_c},
    {dilation, "dilation from theta_d to theta_c", "Sec. VI, Fig. 14", "then it increases", 0.0, 0.0, "1",
     above, "volume strain at theta_c less that at its minimum; none if it does not rise above its noise",
     &FrameRecord::volume_strain, Place::theta_c},
    {volume_strain_at_theta_c, "volume strain at theta_c", "Sec. VI, Fig. 14", "positive", 0.0, 0.0, "1",
     above, "(V - V0)/V0 of the last frame up to theta_c", &FrameRecord::volume_strain, Place::theta_c},

    {overloaded_at_0, "p_o at 0 deg", "Sec. V A, Fig. 9", "about 30 %", 0.30, 0.025, "1", equals,
     "overloaded grains over those that carry something, first frame", &FrameThreshold::overloaded_fraction,
     Place::start},
    {overloaded_at_theta_d, "p_o at theta_d", "Sec. V B, Fig. 9", "0.45", 0.45, 0.025, "1", equals,
     "the same in the frame after the jump of l_c max", &FrameThreshold::overloaded_fraction, Place::theta_d},
    {overloaded_at_theta_c, "p_o at theta_c", "Sec. V A, Fig. 9", "about 60 %", 0.60, 0.025, "1", equals,
     "the same in the last frame up to theta_c", &FrameThreshold::overloaded_fraction, Place::theta_c},
    {overloaded_at_percolation, "p_o at percolation", "Sec. V B", "0.45", 0.45, 0.025, "1", equals,
     "the same in the first frame from which a cluster spans from floor to surface",
     &FrameThreshold::overloaded_fraction, Place::percolation},
    {lc_mean_at_0, "mean l_c at 0 deg", "Sec. V B, Fig. 12a", "4 D", 4.0, 0.5, "D", equals,
     "mean over the overloaded grains, first frame; a diameter", &FrameThreshold::lc_mean, Place::start},
    {lc_mean_at_theta_d, "mean l_c at theta_d", "Sec. V B, Fig. 12a", "5 D", 5.0, 0.5, "D", equals,
     "the same in the frame after the jump of l_c max", &FrameThreshold::lc_mean, Place::theta_d},
    {lc_mean_at_theta_c, "mean l_c at theta_c", "Sec. V B, Fig. 12a", "about 7 D", 7.0, 0.5, "D", equals,
     "the same in the last frame up to theta_c", &FrameThreshold::lc_mean, Place::theta_c},
    {lc_max_at_0, "largest l_c at 0 deg", "Sec. V B, Fig. 12b", "5 D", 5.0, 2.5, "D", equals,
     "largest over the overloaded grains, first frame", &FrameThreshold::lc_max, Place::start},
    {lc_max_before_jump, "largest l_c just below theta_d", "Sec. V B, Fig. 12b", "15 D", 15.0, 2.5, "D",
     equals, "the same in the frame before its jump", &FrameThreshold::lc_max, Place::before_theta_d},
    {lc_max_after_jump, "largest l_c just above theta_d", "Sec. V B, Fig. 12b", "30 D, the cut", 30.0, 2.5,
     "D", equals, "the same in the frame after its jump, but at most 30 D, the cut of the paper",
     &FrameThreshold::lc_max, Place::theta_d},
    {theta_d_by_jump, "theta_d: jump of l_c max", "Sec. V B, Fig. 12b", "15 deg", 15.0, 0.5, "deg", equals,
     "frame after the largest increase, up to where the cut is reached", &RunThreshold::lc_jump, Place::run},
    {theta_d_by_percolation, "theta_d: percolation", "Sec. V B, Fig. 13", "15 deg", 15.0, 0.5, "deg", equals,
     "first of at least 3 frames in a row in which a cluster spans from floor to surface",
     &RunThreshold::percolation, Place::run},
    {theta_d_by_dilation, "theta_d: onset of dilation", "Sec. VI, Fig. 14", "15 deg", 15.0, 0.5, "deg",
     equals,
     "minimum of the volume strain, a mean over 1 deg; none if it does not rise above its noise; an upper "
     "bound if its range begins at the first tilt",
     &Analysis::dilation, Place::run},

    {theta_c_of_walls, "theta_c", "Sec. IV, Fig. 4", "about 19 to 21 deg, all beds", 20.0, 1.0, "deg", equals,
     "tilt at which the final, sustained flow began", &Analysis::theta_c, Place::run},
    {shear_over_tangent_of_walls, "sigma_T/sigma_N over tan(theta) at theta_c", "Eq. 15, Fig. 7",
     "1 - (k_L - k_0)/3 H/L", 1.0, 0.0, "1", equals, "mean over the last half degree up to theta_c",
     &Analysis::failure_ratio, Place::run},
    {wall_gradient, "sigma_xx grows downslope at theta_c", "Sec. IV, Fig. 6", "gradient along the bed", 0.0,
     0.0, "1", above,
     "mean sigma_xx of the lower half of the bed less that of the upper, over their mean; last half "
     "degree up to theta_c",
     &FrameRecord::section_sigma_xx, Place::theta_c},
    {wall_coefficient, "k_L - k_0", "Eq. 15, Fig. 7", "about 2.5", wall_coefficient_value,
     wall_coefficient_accuracy, "1", equals,
     "least squares of Eq. 15 on the ratios of all beds between walls, with the standard error of the fit",
     &Analysis::failure_ratio, Place::run},
}};

std::span<const PaperValue> packing_values() { return from_to(solid_fraction, overloaded_at_0); }
std::span<const PaperValue> chain_values() { return from_to(overloaded_at_0, theta_c_of_walls); }
std::span<const PaperValue> wall_values() { return from_to(theta_c_of_walls, wall_coefficient); }

double paper_wall_ratio(double depth_over_length) {
  return 1.0 - wall_coefficient_value / 3.0 * depth_over_length;
}

PaperValue paper_value_of_walls(PaperQuantity quantity, double depth_over_length) {
  PaperValue paper = paper_value(quantity);
  if (quantity != shear_over_tangent_of_walls) return paper;
  paper.value = paper_wall_ratio(depth_over_length);
  paper.accuracy = wall_coefficient_accuracy / 3.0 * depth_over_length;
  return paper;
}

}  // namespace talus::studies
