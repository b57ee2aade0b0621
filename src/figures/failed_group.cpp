#include "figures/failed_group.h"

#include <cmath>
#include <fmt/core.h>

#include "core/trigonometry.h"
#include "figures/run_means.h"
#include "pictures/frame_choice.h"
#include "scenario/text.h"

namespace talus::figures {
namespace {

/// Returns the first group with failed runs that `choose` keeps.
std::optional<FailedGroup> first_group(std::span<const RunGroup> groups, RunChoice (*choose)(RunChoice)) {
  for (const RunGroup& group : groups)
    if (RunChoice runs = choose(failed_runs(group)); !runs.empty())
      return FailedGroup{&group, std::move(runs)};
  return std::nullopt;
}

}  // namespace

std::optional<FailedGroup> first_failed_group(std::span<const RunGroup> groups) {
  return first_group(groups, with_frames);
}

std::optional<FailedGroup> first_group_with_distributions(std::span<const RunGroup> groups) {
  return first_group(groups, with_distributions);
}

std::string first_run_text(const FailedGroup& failed) {
  return fmt::format("{}, seed {}", failed.group->label, failed.first().scenario.seed);
}

std::size_t repose_frame(const runs::RunView& run) {
  const analysis::FramesOfRise rise = runs::last_rise_of(run);
  return rise.first + pictures::frame_at_repose(rise.tilts, theta_c_of(run));
}

std::string rounded_text(double value, int decimals) {
  const double ten_to = std::pow(10.0, decimals);
  return scenario::short_text(std::round(value * ten_to) / ten_to + 0.0);  // avoids "-0"
}

std::string angle_text(double tilt) { return rounded_text(degrees(tilt), 2); }

}  // namespace talus::figures
