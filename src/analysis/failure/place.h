#pragma once
/// Scalar results of a run: quantities of the run itself, and of frames at a characteristic place on the way
/// to failure, such as p_o at theta_c. Ensembles, studies, the comparison with the paper and `--until` use
/// them.

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "analysis/failure/last_rise.h"
#include "analysis/quantities.h"

namespace talus::analysis {

/// The place in a run at which a number is read. The frames are those of the last rise of the tilt. Of
/// several frames at one held tilt, the first counts because later ones may show flow.
enum class Place {
  run,             ///< no place: one number for the run, or one for each threshold
  start,           ///< the first frame
  before_theta_d,  ///< the frame before the jump of l_c max
  theta_d,         ///< the frame after this jump
  percolation,     ///< the first frame from which overloaded grains percolate
  theta_c,         ///< the last frame at or before theta_c
};

/// A scalar result: a quantity, and the place at which it is read.
struct NumberOfRun {
  QuantityMember quantity;
  Place place = Place::run;
};

/// Returns the name, such as "theta_c" or "overloaded/fraction@theta_c".
std::string name_of(const NumberOfRun& number);

/// Returns all scalar results: the quantities of the run in the order of the table of quantities, then those
/// at places.
std::span<const NumberOfRun> numbers_of_run();

/// Tolerance for equal tilts. Tilts are multiples of a step up to rounding; the value suits deg and rad.
inline constexpr double same_tilt = 1e-9;

/// Returns the index of the first of the ascending tilts that equals the last one not after `tilt`; empty if
/// they begin later or `tilt` is NaN.
std::optional<std::size_t> frame_not_after(std::span<const double> tilts, double tilt);

/// Returns the number in the unit of the table of quantities, at threshold f if it depends on one. NaN if the
/// run does not have it: the run has not failed, has no jump, or has no such threshold.
double number_at(const Analysis& analysis, const NumberOfRun& number, std::size_t f = 0);

}  // namespace talus::analysis
