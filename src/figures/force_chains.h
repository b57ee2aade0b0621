#pragma once
/// Pictures of the contacts of a bed just before it fails: their forces, and where friction is fully
/// mobilised.

#include <optional>
#include <span>

#include "core/bed_frame.h"
#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus {

/// Contacts as lines (contact_lines.h), in D, with f_n over its mean, the smallest first, and whether their
/// friction is fully mobilised. Coordinates are rounded to 1e-4 D.
Table force_table(const BedFrame& bed);

/// The force chains of the first run that has failed, at its last frame before theta_c.
std::optional<Figure> force_chains(std::span<const RunGroup> groups);

/// Share, largest cluster and correlation length of the critical contacts over theta, as means over the runs
/// of each group, and where they are in the same frame of the same run.
std::optional<Figure> critical_contacts_figure(std::span<const RunGroup> groups);

}  // namespace talus
