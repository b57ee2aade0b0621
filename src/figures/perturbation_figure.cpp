#include "figures/perturbation_figure.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "analysis/quantities.h"
#include "base/text.h"
#include "core/statistics.h"
#include "core/trigonometry.h"
#include "figures/group_table.h"
#include "scenario/text.h"
#include "session/perturbation_threshold.h"

namespace talus::figures {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

double failure_angle(const runs::RunView& run) { return degrees(run.analysis.theta_c); }

/// Returns the trial at a strength; null if there is none.
const session::Trial* trial_of(const session::PerturbedState& state, double strength) {
  const auto found = std::ranges::find(state.trials, strength, &session::Trial::strength);
  return found == state.trials.end() ? nullptr : &*found;
}

void append_state(Table& table, const runs::RunView& run, const session::PerturbedState& state) {
  const session::Threshold threshold = session::threshold_of(state.trials);
  const bool searched = threshold.held && state.trials.size() > 1;
  const session::Trial* without = searched ? trial_of(state, threshold.without) : nullptr;
  const session::Trial* with = searched ? trial_of(state, threshold.with) : nullptr;
  const double row[] = {static_cast<double>(run.scenario.seed),
                        state.tilt,
                        failure_angle(run),
                        failure_angle(run) - state.tilt,
                        threshold.held ? 1.0 : 0.0,
                        threshold.without,
                        std::isinf(threshold.with) ? no_number : threshold.with,
                        without != nullptr ? without->energy : 0.0,
                        with != nullptr  ? with->energy
                        : threshold.held ? no_number
                                         : 0.0,
                        without != nullptr ? without->moved : no_number,
                        with != nullptr ? with->moved : no_number,
                        threshold.monotone ? 1.0 : 0.0,
                        static_cast<double>(state.trials.size())};
  for (std::size_t k = 0; k < table.columns.size(); ++k) table.columns[k].values.push_back(row[k]);
}

/// Returns theta_c - theta_d, deg, as the mean over the runs that have it; NaN if none has.
double mean_distance(const RunGroup& group, const analysis::QuantityMember& estimator) {
  std::vector<double> distances;
  for (const runs::RunView& run : group.runs)
    distances.push_back(failure_angle(run) -
                        degrees(analysis::number_of(analysis::quantity_of(estimator), run.analysis, 0)));
  return statistics_of(distances).mean;
}

std::string number_text(double value) { return std::isnan(value) ? "NaN" : scenario::short_text(value); }

std::string caption_of(const RunGroup& group, const session::SurfacePatch& patch) {
  return fmt::format(
      "Velocity, and kinetic energy, of the weakest push that starts an avalanche, over the distance to the "
      "angle of repose; {}, {}. The grains of a patch of {} D at the free surface are pushed downslope, in "
      "copies of the bed at rest. Bars go from the largest push of a bisection that started no avalanche to "
      "the smallest that did. Open triangles up: no avalanche up to the largest push; triangles down: beds "
      "that the weakest push set off. Lines: theta_d as the mean distance over the runs, by the jump of l_c "
      "max and by the end of the range in which the volume strain exceeds its minimum by at most its noise.",
      group.label, runs_text(group.runs.size()), session::patch_text(patch));
}

}  // namespace

Table perturbation_states(const RunGroup& group, std::span<const session::PerturbationTable> tables) {
  Table table;
  const auto column = [&table](const char* name, const char* unit, const char* meaning) {
    table.columns.push_back({name, unit, meaning, {}});
  };
  column("seed", "1", "seed of the run");
  column("theta", "deg", "tilt of the state");
  column("theta_c", "deg", "angle of repose of the run");
  column("distance", "deg", "theta_c - theta");
  column("holds", "1", "1 if the bed comes to rest at this tilt by itself, else 0");
  column("v_without", "sqrt(g D)", "largest push of the bisection that started no avalanche; 0: none");
  column("v_with", "sqrt(g D)", "smallest push that did; NaN: none did; 0: no push was needed");
  column("energy_without", "m g D", "kinetic energy of the first; m is the mass of a disk of diameter D");
  column("energy_with", "m g D", "the same of the second");
  column("moved_without", "1", "free grains that the first moved by more than D");
  column("moved_with", "1", "the same of the second, when the avalanche counted as one");
  column("monotone", "1", "0 if a weaker push started an avalanche, or a stronger one did not");
  column("trials", "1", "number of trials, including the one without a push");
  for (std::size_t r = 0; r < group.runs.size(); ++r)
    for (const session::PerturbedState& state : tables[r].states) append_state(table, group.runs[r], state);
  return table;
}

Figure perturbation_figure(const RunGroup& group, std::span<const session::PerturbationTable> tables) {
  Figure figure;
  figure.name = "perturb";
  figure.title = "Weakest push that starts an avalanche";
  figure.caption = caption_of(group, tables.front().plan.patch);
  for (const runs::RunView& run : group.runs) figure.runs.push_back(run.path);
  figure.wide = true;
  figure.height_over_width = 0.4;
  figure.tables = {perturbation_states(group, tables)};
  const std::string seeds =
      joined(group.runs, " ", [](const runs::RunView& run) { return run.scenario.seed; });
  figure.variables = {
      {"seeds", gnuplot_string(seeds)},
      {"theta_d_lc", number_text(mean_distance(group, &analysis::RunThreshold::lc_jump))},
      {"theta_d_dilation", number_text(mean_distance(group, &analysis::Analysis::dilation_high))}};
  return figure;
}

}  // namespace talus::figures
