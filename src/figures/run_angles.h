#pragma once
/// Characteristic angles of each run of several groups.

#include <span>
#include <string>
#include <vector>

#include "figures/figure.h"
#include "figures/group_table.h"
#include "figures/run_group.h"

namespace talus::figures {

/// A scalar angle of a run: theta_c, the first slide, theta_r, or theta_d by one estimator.
struct RunAngle {
  std::string name;                         ///< "theta_d/lc_jump[1]", as in members.csv
  std::string label;                        ///< axis label in enhanced text
  std::string meaning;                      ///< description in a table
  std::vector<std::vector<double>> values;  ///< deg, by group and run; NaN for a run without the angle
};

/// Returns all angles that at least two runs of a group have. `choices`: the runs of each group.
std::vector<RunAngle> run_angles(const std::vector<RunChoice>& choices);

/// The groups with several runs, and their angles.
struct AngleGroups {
  std::vector<const RunGroup*> groups;
  std::vector<RunChoice> choices;
  std::vector<RunAngle> angles;
};
/// Returns the groups with several runs, and their angles.
AngleGroups angle_groups(std::span<const RunGroup> groups);

/// Adds a table for each group with the seed and all angles of each run.
void add_angle_tables(Figure& figure, const AngleGroups& all);

/// Returns the largest of 1, 2, 2.5 and 5 times a power of ten that does not exceed `most` > 0.
double round_step(double most);

}  // namespace talus::figures
