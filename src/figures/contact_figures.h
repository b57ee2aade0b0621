#pragma once
/// Distributions and correlations of contacts and forces, at the start of the tilt and before failure, as
/// means over the runs of the first group that has failed.

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "figures/figure.h"
#include "figures/group_table.h"

namespace talus {

/// Means over runs, element by element, of what frame frames[r] of run r has, with their standard errors:
/// the columns NAME and NAME_error. All are of the same length.
std::vector<Column> row_means(const RunChoice& runs, std::span<const std::size_t> frames,
                              std::vector<double> FrameRecord::*member, Column mean);

/// Polar histogram of the directions of contact normals, each contact counted once, and weighted by f_n.
std::optional<Figure> contact_directions(std::span<const RunGroup> groups);
/// Probability density of the normal forces over their mean.
std::optional<Figure> force_distribution(std::span<const RunGroup> groups);
/// Correlation of normal forces, of gamma and of the mean stress of grains, over distance.
std::optional<Figure> correlations(std::span<const RunGroup> groups);
/// Fabric of the weak contacts along the strong ones, over their mobilised friction.
std::optional<Figure> weak_contacts_figure(std::span<const RunGroup> groups);

}  // namespace talus
