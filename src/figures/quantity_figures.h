#pragma once
/// Every quantity of frames that has a title, in a panel of its own: all groups over each other, and the
/// difference of two.

#include <optional>
#include <span>

#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus {

/// Means over the tilt, and over theta_c - theta. What depends on the threshold is that at the first one.
std::optional<Figure> quantities_over_tilt(std::span<const RunGroup> groups);
std::optional<Figure> quantities_before_failure(std::span<const RunGroup> groups);

/// Of these, those of the contacts that tell how far failure is, over theta_c - theta.
std::optional<Figure> precursors_figure(std::span<const RunGroup> groups);

/// The means of the second group less those of the first, with the errors of both, at the angles that both
/// have; nothing unless there are two groups.
std::optional<Figure> differences_over_tilt(std::span<const RunGroup> groups);
std::optional<Figure> differences_before_failure(std::span<const RunGroup> groups);

}  // namespace talus
