#pragma once
/// Values that the paper reports, as plain data; none of them is ours.

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "analysis/failure/place.h"

namespace talus::studies {

/// Quantities for which the paper gives a value. Places such as theta_d refer to the same run; theta_d is the
/// tilt at which l_c max jumps.
enum class PaperQuantity : std::size_t {
  // of the periodic bed
  solid_fraction,
  coordination_number,
  normals_near_0,
  normals_near_60,
  normals_near_120,
  stress_ratio_at_0,
  theta_c,
  shear_over_tangent,
  stress_ratio_over_sine,
  contraction,
  dilation,
  volume_strain_at_theta_c,
  // of the periodic bed, with a threshold for overloaded grains: the chain from p_o to theta_d
  overloaded_at_0,
  overloaded_at_theta_d,
  overloaded_at_theta_c,
  overloaded_at_percolation,
  lc_mean_at_0,
  lc_mean_at_theta_d,
  lc_mean_at_theta_c,
  lc_max_at_0,
  lc_max_before_jump,
  lc_max_after_jump,
  theta_d_by_jump,
  theta_d_by_percolation,
  theta_d_by_dilation,
  // of beds between walls
  theta_c_of_walls,
  shear_over_tangent_of_walls,
  wall_gradient,
  wall_coefficient,
  count
};
inline constexpr std::size_t quantity_count = static_cast<std::size_t>(PaperQuantity::count);

enum class Relation {
  equals,  ///< within `accuracy` of `value`
  above,   ///< the paper states only that it exceeds `value`
};

/// One value of the paper. Its accuracy is half a step of the printed number or of the scale from which it
/// was read; for theta_c, given as one range for all beds, half the width of the range.
struct PaperValue {
  PaperQuantity quantity;
  std::string_view name;   ///< "p_o at 0 deg"
  std::string_view where;  ///< "Sec. V A, Fig. 9"
  std::string_view text;   ///< wording of the paper: "about 30 %"
  double value;
  double accuracy;
  std::string_view unit;  ///< "deg", "D", or "1"
  Relation relation;
  std::string_view definition;                   ///< definition of our value
  analysis::QuantityMember source;               ///< analysis quantity from which ours is read or computed
  analysis::Place place = analysis::Place::run;  ///< place at which it is read
};

/// Table with one row for each quantity, in their order.
extern const std::array<PaperValue, quantity_count> paper_values;
inline const PaperValue& paper_value(PaperQuantity quantity) {
  return paper_values[static_cast<std::size_t>(quantity)];
}

/// Returns the values of the periodic bed that need no threshold.
std::span<const PaperValue> packing_values();
/// Returns the values that need a threshold, and the onset of dilation: the paper's chain.
std::span<const PaperValue> chain_values();
/// Returns the values of beds between walls.
std::span<const PaperValue> wall_values();

/// Depth of the paper's beds and cut of l_c in its data processing, D.
inline constexpr double paper_depth = 40.0;
inline constexpr double paper_lc_cut = 30.0;

/// Returns (sigma_T / sigma_N) / tan(theta) of a bed between walls by Eq. 15 with the paper's k_L - k_0.
double paper_wall_ratio(double depth_over_length);

/// Returns the paper's value for a bed between walls with this H / L; only sigma_T / sigma_N depends on it.
PaperValue paper_value_of_walls(PaperQuantity quantity, double depth_over_length);

}  // namespace talus::studies
