#pragma once
/// What a run gives for the quantities of the paper, read from its analysis.

#include <array>
#include <cstddef>
#include <span>

#include "runs/run_view.h"
#include "studies/paper_values.h"
#include "studies/wall_fit.h"

namespace talus::studies {

/// Grains that p_o is a share of.
enum class Population {
  carrying,  ///< those that carry something, as gamma is known for no others
  all,       ///< all free grains
};

/// A number in the unit of the paper's value; NaN where the run has none.
struct Measured {
  double value = 0.0;
  bool at_most = false;  ///< no more is known than that it is not above the value: so from the first frame on
};

/// The quantity in a run that has failed, with threshold `factor` (an index) of its analysis. NaN where the
/// slope has not failed, and for the coefficient of the walls, which no single run has.
Measured measure(const runs::RunView& run, PaperQuantity quantity, std::size_t factor, Population population);

/// Of all quantities.
using MeasuredValues = std::array<Measured, quantity_count>;
MeasuredValues measure_all(const runs::RunView& run, std::size_t factor, Population population);
inline const Measured& at(const MeasuredValues& values, PaperQuantity quantity) {
  return values[static_cast<std::size_t>(quantity)];
}

/// H / L and the ratio of a bed at failure; the ratio is NaN where it has not failed.
WallPoint wall_point(const runs::RunView& run);

}  // namespace talus::studies
