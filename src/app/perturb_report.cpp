#include "app/perturb_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/trigonometry.h"
#include "session/perturbation_threshold.h"

namespace talus {
namespace {

/// Upper edges of the ranges of theta_c - theta of the first table, deg.
constexpr std::array<double, 7> range_edges = {0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 60.0};

struct MeasuredState {
  std::uint64_t seed = 0;
  double tilt = 0.0;     ///< deg
  double theta_c = 0.0;  ///< deg, NaN where the slope has not failed
  Threshold threshold;
  Index moved = 0;  ///< by the push at the upper end of the bracket; 0 where there is none
};

std::vector<MeasuredState> states_of(const RunGroup& group, std::span<const PerturbationTable> tables) {
  std::vector<MeasuredState> found;
  for (std::size_t r = 0; r < group.runs.size(); ++r) {
    const double theta_c = degrees(values<double>(group.runs[r].analysis, "theta_c").front());
    for (const PerturbedState& state : tables[r].states) {
      MeasuredState measured{group.runs[r].scenario.seed, state.tilt, theta_c, threshold_of(state.trials), 0};
      for (const Trial& trial : state.trials)
        if (trial.strength == measured.threshold.with) measured.moved = trial.moved;
      found.push_back(measured);
    }
  }
  return found;
}

template <typename... Values>
std::string text_of(const char* form, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, form, values...);
  return text;
}

/// The middle of a bracket on a logarithmic scale; beds that need no push, or less than the weakest, count
/// with the weakest, beds that no push set off as infinite.
double middle(const Threshold& threshold) {
  return std::sqrt(std::max(threshold.without, weakest_push) * std::max(threshold.with, weakest_push));
}

std::string push_text(double strength) {
  if (std::isinf(strength)) return text_of("> %.3g", strongest_push);
  return strength <= weakest_push ? text_of("< %.3g", weakest_push) : text_of("%.2f", strength);
}

/// The row of the states whose distance to theta_c lies in (low, high]; nothing where there is none.
std::string range_row(const std::vector<MeasuredState>& states, double low, double high) {
  std::vector<double> middles;
  int alone = 0, none = 0, erratic = 0;
  for (const MeasuredState& state : states) {
    const double distance = state.theta_c - state.tilt;
    if (!(distance > low && distance <= high)) continue;
    middles.push_back(middle(state.threshold));
    alone += state.threshold.held ? 0 : 1;
    none += std::isinf(state.threshold.with) ? 1 : 0;
    erratic += state.threshold.monotone ? 0 : 1;
  }
  if (middles.empty()) return {};
  std::ranges::sort(middles);
  const std::string range =
      high < range_edges.back() ? text_of("%.3g - %.3g", low, high) : text_of("> %.3g", low);
  return text_of("| %s | %zu | %d | %d | %d | %s | %s | %s |\n", range.c_str(), middles.size(), alone, none,
                 erratic, push_text(middles.front()).c_str(), push_text(middles[middles.size() / 2]).c_str(),
                 push_text(middles.back()).c_str());
}

std::string state_row(const MeasuredState& state) {
  const Threshold& threshold = state.threshold;
  std::string bracket = "does not hold";
  if (threshold.held)
    bracket = std::isinf(threshold.with) ? text_of("> %.3g", threshold.without)
                                         : text_of("%.3g ... %.3g", threshold.without, threshold.with);
  const std::string moved = state.moved > 0 ? std::to_string(state.moved) : "-";
  const std::string distance = std::isnan(state.theta_c) ? "-" : text_of("%.2f", state.theta_c - state.tilt);
  return text_of("| %llu | %.2f | %s | %s%s | %s |\n", static_cast<unsigned long long>(state.seed),
                 state.tilt, distance.c_str(), bracket.c_str(), threshold.monotone ? "" : ", erratic",
                 moved.c_str());
}

}  // namespace

std::string perturbation_markdown(const RunGroup& group, std::span<const PerturbationTable> tables) {
  const std::vector<MeasuredState> states = states_of(group, tables);
  std::string text = "# Weakest push that starts an avalanche\n\n" + group.label + ", patch of " +
                     patch_text(tables.front().plan.patch) + " D, " + std::to_string(states.size()) +
                     " states of " + std::to_string(group.runs.size()) +
                     (group.runs.size() == 1 ? " run" : " runs") +
                     ". Pushes in sqrt(g D), angles in deg. Least, median and most are those of the middles "
                     "of the brackets.\n\n";
  text +=
      "| theta_c - theta | states | do not hold | no avalanche | erratic | least | median | most |\n"
      "|---|--:|--:|--:|--:|--:|--:|--:|\n";
  double low = 0.0;
  for (const double high : range_edges) {
    text += range_row(states, low, high);
    low = high;
  }
  text += "\n| seed | theta | theta_c - theta | bracket | grains moved |\n|--:|--:|--:|---|--:|\n";
  for (const MeasuredState& state : states) text += state_row(state);
  return text;
}

}  // namespace talus
