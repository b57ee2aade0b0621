/// Results of perturbed runs as Markdown tables.

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <vector>

#include "base/text_table.h"
#include "core/trigonometry.h"
#include "figures/group_table.h"
#include "figures/perturbation_figure.h"
#include "session/perturbation_threshold.h"

namespace talus::figures {
namespace {

/// Upper edges of the ranges of theta_c - theta in the first table, deg.
constexpr std::array<double, 7> range_edges = {0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 60.0};

struct MeasuredState {
  std::uint64_t seed = 0;
  double tilt = 0.0;     ///< deg
  double theta_c = 0.0;  ///< deg, NaN if the slope has not failed
  session::Threshold threshold;
  Index moved = 0;  ///< grains moved by the push at the upper end of the bracket; 0 if there is none
};

std::vector<MeasuredState> states_of(const RunGroup& group,
                                     std::span<const session::PerturbationTable> tables) {
  std::vector<MeasuredState> found;
  for (std::size_t r = 0; r < group.runs.size(); ++r) {
    const double theta_c = degrees(group.runs[r].analysis.theta_c);
    for (const session::PerturbedState& state : tables[r].states) {
      MeasuredState measured{group.runs[r].scenario.seed, state.tilt, theta_c,
                             session::threshold_of(state.trials), 0};
      for (const session::Trial& trial : state.trials)
        if (trial.strength == measured.threshold.with) measured.moved = trial.moved;
      found.push_back(measured);
    }
  }
  return found;
}

/// Returns the logarithmic midpoint of a bracket. Beds that need no push, or less than the weakest, count
/// with the weakest; beds that no push sets off count as infinite.
double middle(const session::Threshold& threshold) {
  return std::sqrt(std::max(threshold.without, session::weakest_push) *
                   std::max(threshold.with, session::weakest_push));
}

std::string push_text(double strength) {
  if (std::isinf(strength)) return fmt::format("> {:.3g}", session::strongest_push);
  return strength <= session::weakest_push ? fmt::format("< {:.3g}", session::weakest_push)
                                           : fmt::format("{:.2f}", strength);
}

/// Adds the row of the states at a distance to theta_c in (low, high], if there are any.
void add_range(TextTable& table, const std::vector<MeasuredState>& states, double low, double high) {
  std::vector<double> middles;
  std::size_t alone = 0, none = 0, erratic = 0;
  for (const MeasuredState& state : states) {
    const double distance = state.theta_c - state.tilt;
    if (!(distance > low && distance <= high)) continue;
    middles.push_back(middle(state.threshold));
    alone += state.threshold.held ? 0 : 1;
    none += std::isinf(state.threshold.with) ? 1 : 0;
    erratic += state.threshold.monotone ? 0 : 1;
  }
  if (middles.empty()) return;
  std::ranges::sort(middles);
  const double median = 0.5 * (middles[(middles.size() - 1) / 2] + middles[middles.size() / 2]);
  const std::string range =
      high < range_edges.back() ? fmt::format("{:.3g} - {:.3g}", low, high) : fmt::format("> {:.3g}", low);
  auto& row = table.rows.emplace_back();
  row = {{range}};
  for (const std::size_t count : {middles.size(), alone, none, erratic})
    row.push_back({std::to_string(count)});
  for (const double value : {middles.front(), median, middles.back()}) row.push_back({push_text(value)});
}

std::vector<TextCell> state_row(const MeasuredState& state) {
  const session::Threshold& threshold = state.threshold;
  std::string bracket = "does not hold";
  if (threshold.held)
    bracket = std::isinf(threshold.with)
                  ? fmt::format("> {:.3g}", threshold.without)
                  : fmt::format("{:.3g} ... {:.3g}", threshold.without, threshold.with);
  return {{std::to_string(state.seed)},
          {fmt::format("{:.2f}", state.tilt)},
          {number_cell("{:.2f}", state.theta_c - state.tilt)},
          {bracket + (threshold.monotone ? "" : ", erratic")},
          {state.moved > 0 ? std::to_string(state.moved) : "-"}};
}

}  // namespace

std::string perturbation_markdown(const RunGroup& group, std::span<const session::PerturbationTable> tables) {
  const std::vector<MeasuredState> states = states_of(group, tables);
  TextTable ranges{{{"theta_c - theta"}}, {}};
  for (const char* title : {"states", "do not hold", "no avalanche", "erratic", "least", "median", "largest"})
    ranges.columns.push_back({title, true});
  double low = 0.0;
  for (const double high : range_edges) {
    add_range(ranges, states, low, high);
    low = high;
  }
  TextTable each{
      {{"seed", true}, {"theta", true}, {"theta_c - theta", true}, {"bracket"}, {"grains moved", true}}, {}};
  for (const MeasuredState& state : states) each.rows.push_back(state_row(state));
  return fmt::format(
      "# Weakest push that starts an avalanche\n\n{}, patch of {} D, {} states of {}. Pushes in sqrt(g D), "
      "angles in deg. Least, median and largest refer to the midpoints of the brackets.\n\n{}\n{}",
      group.label, session::patch_text(tables.front().plan.patch), states.size(),
      runs_text(group.runs.size()), markdown_text(ranges), markdown_text(each));
}

}  // namespace talus::figures
