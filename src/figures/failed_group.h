#pragma once
/// The failed runs for figures of one bed or one ensemble.

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "figures/group_table.h"

namespace talus::figures {

/// The failed runs of a group that a figure shows, at least one.
struct FailedGroup {
  const RunGroup* group = nullptr;
  RunChoice runs;

  /// Returns the run shown in pictures of a single bed.
  const runs::RunView& first() const { return *runs.front(); }
};

/// Return the first group with failed runs whose files, or whose distributions, are available. Periodic beds
/// come first (group_runs).
std::optional<FailedGroup> first_failed_group(std::span<const RunGroup> groups);
std::optional<FailedGroup> first_group_with_distributions(std::span<const RunGroup> groups);

/// Describes the first run: "PBC, L = 200 D, seed 1".
std::string first_run_text(const FailedGroup& failed);

/// Returns the number of the last frame before theta_c.
std::size_t repose_frame(const runs::RunView& run);

/// Returns a value with at most the given number of decimals: "13.25", "0".
std::string rounded_text(double value, int decimals);
/// Returns a tilt (rad) in degrees with at most two decimals.
std::string angle_text(double tilt);

}  // namespace talus::figures
