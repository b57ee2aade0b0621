#pragma once
/// What figures of one bed, or of one ensemble, are made of.

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "figures/group_table.h"

namespace talus::figures {

/// The failed runs of a group from which a figure is made, one at least.
struct FailedGroup {
  const RunGroup* group = nullptr;
  RunChoice runs;

  /// The run of pictures that show one bed.
  const runs::RunView& first() const { return *runs.front(); }
};

/// The first group that has such runs with their files, or with their distributions; periodic beds come first
/// (group_runs).
std::optional<FailedGroup> first_failed_group(std::span<const RunGroup> groups);
std::optional<FailedGroup> first_group_with_distributions(std::span<const RunGroup> groups);

/// "PBC, L = 200 D, seed 1": the first run.
std::string first_run_text(const FailedGroup& failed);

/// The last frame before theta_c.
std::size_t repose_frame(const runs::RunView& run);

/// A value with at most so many decimals: "13.25", "0".
std::string rounded_text(double value, int decimals);
/// A tilt (rad) in degrees, with two decimals at most.
std::string angle_text(double tilt);

}  // namespace talus::figures
