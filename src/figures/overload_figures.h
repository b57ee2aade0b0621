#pragma once
/// Overloaded grains of periodic beds over tilt (paper, section V).

#include <optional>
#include <span>

#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus {

/// Probability density of gamma at 0, 10 and 15 deg (paper, Fig. 8).
std::optional<Figure> gamma_density_figure(std::span<const RunGroup> groups);

/// p_o over tilt, for each threshold (paper, Fig. 9).
std::optional<Figure> overloaded_fraction_figure(std::span<const RunGroup> groups);

/// Mean and largest l_c over tilt, for each threshold (paper, Fig. 12).
std::optional<Figure> length_figure(std::span<const RunGroup> groups);

/// p_o over the size of neighbourhoods, at 0 and 15 deg and just before failure.
std::optional<Figure> overload_scale_figure(std::span<const RunGroup> groups);

}  // namespace talus
