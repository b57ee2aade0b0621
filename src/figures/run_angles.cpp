#include "figures/run_angles.h"

#include <algorithm>
#include <cmath>

#include "core/statistics.h"
#include "core/trigonometry.h"
#include "ensemble/member_values.h"
#include "figures/theta_d_estimators.h"

namespace talus::figures {
namespace {

constexpr int min_runs = 2;

}  // namespace

std::vector<RunAngle> run_angles(const std::vector<RunChoice>& choices) {
  std::vector<RunAngle> angles;
  const auto add = [&](RunAngle angle, const auto& value_of) {
    bool is_known = false;
    for (const RunChoice& runs : choices) {
      std::vector<double>& values = angle.values.emplace_back();
      for (const runs::RunView* run : runs) values.push_back(value_of(*run));
      is_known = is_known || statistics_of(values).count >= min_runs;
    }
    if (is_known) angles.push_back(std::move(angle));
  };
  add({analysis::quantity_of(&analysis::Analysis::theta_c).name,
       "{/:Italic θ_c}",
       "theta_c, angle of repose",
       {}},
      [](const runs::RunView& run) { return degrees(run.analysis.theta_c); });
  add({analysis::quantity_of(&analysis::Analysis::first_slide).name,
       "first slide",
       "first slide of the surface layer",
       {}},
      [](const runs::RunView& run) { return degrees(run.analysis.first_slide); });
  add({"theta_r", "{/:Italic θ_r}", "theta_r, angle at rest after failure", {}},
      [](const runs::RunView& run) { return degrees(run.theta_r); });
  RunChoice all;
  for (const RunChoice& runs : choices) all.insert(all.end(), runs.begin(), runs.end());
  if (all.empty()) return angles;
  std::vector<Estimator> estimators = estimators_of(max_analysed(all));
  std::ranges::reverse(estimators);
  for (const Estimator& estimator : estimators)
    add({ensemble::element_name(analysis::quantity_of(estimator.member).name, estimator.element),
         "{/:Italic θ_d} (" + estimator.label + ")",
         "theta_d, " + estimator.meaning,
         {}},
        [&](const runs::RunView& run) { return theta_d_of(run, estimator); });
  return angles;
}

AngleGroups angle_groups(std::span<const RunGroup> groups) {
  AngleGroups found;
  for (const RunGroup& group : groups) {
    if (group.runs.size() < min_runs) continue;
    found.groups.push_back(&group);
    found.choices.push_back(all_runs(group));
  }
  if (!found.groups.empty()) found.angles = run_angles(found.choices);
  return found;
}

void add_angle_tables(Figure& figure, const AngleGroups& all) {
  for (std::size_t g = 0; g < all.groups.size(); ++g) {
    std::vector<Column> columns = {{"seed", "1", "seed of the run", {}}};
    for (const runs::RunView* run : all.choices[g])
      columns[0].values.push_back(static_cast<double>(run->scenario.seed));
    for (const RunAngle& angle : all.angles)
      columns.push_back({angle.name, "deg", angle.meaning, angle.values[g]});
    add_group_table(figure, *all.groups[g], all.choices[g], std::move(columns));
  }
}

double round_step(double most) {
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  double step = decade;
  for (const double factor : {2.0, 2.5, 5.0})
    if (factor * decade <= most) step = factor * decade;
  return step;
}

}  // namespace talus::figures
