#pragma once
/// Numbers of a run: its own, and those of its frames at a place on the way to failure, such as p_o at
/// theta_c. Ensembles, studies, the comparison with the paper and `--until` go by them.

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "analysis/failure/last_rise.h"
#include "analysis/quantities.h"

namespace talus::analysis {

/// Where in a run a number is read. Frames are those of the last rise of the tilt; of those at one tilt,
/// where it is held, the first: what came later may be flow.
enum class Place {
  run,             ///< nowhere: there is one number in the run, or one for each threshold
  start,           ///< the first frame
  before_theta_d,  ///< the frame before the jump of l_c max
  theta_d,         ///< the frame after it
  percolation,     ///< the first frame from which on overloaded grains percolate
  theta_c,         ///< the last frame not after theta_c
};

struct NumberOfRun {
  QuantityMember quantity;
  Place place = Place::run;
};

/// "theta_c", "overloaded/fraction@theta_c".
std::string name_of(const NumberOfRun& number);

/// All of them: the numbers of the run itself in the order of the table of quantities, then those at places.
std::span<const NumberOfRun> numbers_of_run();

/// Tilts are multiples of a step up to rounding: two that are meant to be equal differ by less, in any unit.
inline constexpr double same_tilt = 1e-9;

/// Of ascending tilts the first that equals the last one not after `tilt`: an index; none where they begin
/// later, or `tilt` is not known.
std::optional<std::size_t> frame_not_after(std::span<const double> tilts, double tilt);

/// The number in the unit of the table of quantities, at threshold f where it depends on one. NaN where the
/// run does not have it: it has not failed, there is no jump, or no such threshold.
double number_at(const Analysis& analysis, const NumberOfRun& number, std::size_t f = 0);

}  // namespace talus::analysis
