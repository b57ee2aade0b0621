#pragma once
/// The angles at which something happens in each run of some groups.

#include <span>
#include <string>
#include <vector>

#include "figures/figure.h"
#include "figures/group_table.h"
#include "figures/run_group.h"

namespace talus::figures {

/// An angle that there is one of in a run: theta_c, the first slide, theta_r, or theta_d by an estimator.
struct RunAngle {
  std::string name;     ///< "theta_d/lc_jump[1]", as in members.csv
  std::string label;    ///< for an axis, in enhanced text
  std::string meaning;  ///< for a table
  std::vector<std::vector<double>>
      values;  ///< of each group, of each of its runs, deg; NaN where it has none
};

/// All angles that at least two runs of a group have. `choices`: the runs of each group.
std::vector<RunAngle> run_angles(const std::vector<RunChoice>& choices);

/// The groups that have several runs, and their angles.
struct AngleGroups {
  std::vector<const RunGroup*> groups;
  std::vector<RunChoice> choices;
  std::vector<RunAngle> angles;
};
AngleGroups angle_groups(std::span<const RunGroup> groups);

/// Adds a table for each group: the seed, and all angles, of each run.
void add_angle_tables(Figure& figure, const AngleGroups& all);

/// The largest of 1, 2, 2.5 and 5 times a power of ten that is not above `most`, which is positive.
double round_step(double most);

}  // namespace talus::figures
