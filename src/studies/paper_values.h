#pragma once
/// What the paper reports, number by number, as plain data. Nothing here is ours.

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "analysis/failure/place.h"

namespace talus::studies {

/// What the paper gives a value for. Angles of the tilt are those of the same run: theta_d is the tilt of the
/// jump of l_c max.
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
  above,   ///< the paper says no more than that it is above `value`
};

/// The accuracy is half a step of the number as it is printed, or of the scale that it was read from.
struct PaperValue {
  PaperQuantity quantity;
  std::string_view name;   ///< "p_o at 0 deg"
  std::string_view where;  ///< "Sec. V A, Fig. 9"
  std::string_view text;   ///< as printed: "about 30 %"
  double value;
  double accuracy;
  std::string_view unit;  ///< "deg", "D", or "1"
  Relation relation;
  std::string_view definition;                   ///< how ours is measured
  analysis::QuantityMember source;               ///< what it is read from, or made from, ...
  analysis::Place place = analysis::Place::run;  ///< ... and where
};

/// One row for each quantity, in their order.
extern const std::array<PaperValue, quantity_count> paper_values;
inline const PaperValue& paper_value(PaperQuantity quantity) {
  return paper_values[static_cast<std::size_t>(quantity)];
}

/// The quantities of the periodic bed that need no threshold.
std::span<const PaperValue> packing_values();
/// Those that need one, and the onset of dilation that belongs to them: the paper's chain.
std::span<const PaperValue> chain_values();
/// Those of beds between walls.
std::span<const PaperValue> wall_values();

/// The depth of the paper's beds, and the cut of l_c in its data processing; D.
inline constexpr double paper_depth = 40.0;
inline constexpr double paper_lc_cut = 30.0;

/// k_L - k_0 of the paper, and its Eq. 15 with it: (sigma_T / sigma_N) / tan(theta) of a bed between walls.
double paper_wall_ratio(double depth_over_length);

/// The value of a bed between walls that has H / L of the paper's; that of other quantities is the table's.
PaperValue paper_value_of_walls(PaperQuantity quantity, double depth_over_length);

}  // namespace talus::studies
