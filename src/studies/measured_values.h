#pragma once
/// Values of the paper's quantities in one run, read from its analysis.

#include <array>
#include <cstddef>
#include <span>

#include "runs/run_view.h"
#include "studies/paper_values.h"
#include "studies/wall_fit.h"

namespace talus::studies {

/// Population of grains over which p_o is a fraction.
enum class Population {
  carrying,  ///< free grains that carry a force, the only ones with a gamma
  all,       ///< all free grains
};

/// A number in the unit of the paper's value; NaN if the run has none.
struct MeasuredValue {
  double value = 0.0;
  bool at_most = false;  ///< `value` is only an upper bound, because the event precedes the first frame
};

/// Returns the quantity in a run that has failed, at the threshold with index `factor` of its analysis. NaN
/// if the slope has not failed, and for the wall coefficient, which is fitted to many runs.
MeasuredValue measure(const runs::RunView& run, PaperQuantity quantity, std::size_t factor,
                      Population population);

/// Values of all quantities, in their order.
using MeasuredValues = std::array<MeasuredValue, quantity_count>;
MeasuredValues measure_all(const runs::RunView& run, std::size_t factor, Population population);
inline const MeasuredValue& at(const MeasuredValues& values, PaperQuantity quantity) {
  return values[static_cast<std::size_t>(quantity)];
}

/// Returns H / L and the stress ratio of a bed at failure; the ratio is NaN if the bed has not failed.
WallPoint wall_point(const runs::RunView& run);

}  // namespace talus::studies
