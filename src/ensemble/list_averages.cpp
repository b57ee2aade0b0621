#include "ensemble/list_averages.h"

#include <algorithm>
#include <cmath>

#include "ensemble/averages.h"

namespace talus::ensemble {
namespace {

/// Returns the averages of a list, with room for `points` points.
AveragedList& averages_for(std::vector<AveragedList>& all, const NamedList& list, std::size_t points) {
  auto found = std::ranges::find(all, list.name, &AveragedList::name);
  if (found == all.end()) found = all.insert(all.end(), {list.name, list.unit, list.definition, list.width});
  const std::size_t size = std::max(found->count.size(), points * list.width);
  found->count.resize(size, 0.0);
  found->mean.resize(size, std::nan(""));
  found->squares.resize(size, 0.0);
  return *found;
}

/// Updates mean and variance (Welford 1962).
void add_value(AveragedList& list, std::size_t k, double value) {
  if (std::isnan(value)) return;
  list.count[k] += 1.0;
  if (list.count[k] == 1.0) list.mean[k] = 0.0;
  const double before = value - list.mean[k];
  list.mean[k] += before / list.count[k];
  list.squares[k] += before * (value - list.mean[k]);
}

/// Adds the lists of a member at the tilts (deg) that correspond to the points of a grid.
void add_at(std::vector<AveragedList>& all, const MemberLists& lists, const std::vector<double>& tilts) {
  for (const NamedList& list : lists.lists) {
    AveragedList& averages = averages_for(all, list, tilts.size());
    if (averages.width != list.width) continue;
    for (std::size_t k = 0; k < list.width; ++k) {
      std::vector<double> values;
      for (std::size_t frame = 0; frame < lists.theta.size(); ++frame)
        values.push_back(list.values[frame * list.width + k]);
      for (std::size_t point = 0; point < tilts.size(); ++point)
        add_value(averages, point * list.width + k, interpolated(lists.theta, values, tilts[point]));
    }
  }
}

bool same_bins(const std::vector<NamedList>& left, const std::vector<NamedList>& right) {
  return std::ranges::equal(left, right, [](const NamedList& a, const NamedList& b) {
    return a.name == b.name && a.values == b.values;
  });
}

}  // namespace

std::vector<double> deviation_of(const AveragedList& list) {
  std::vector<double> deviation;
  for (std::size_t k = 0; k < list.count.size(); ++k)
    deviation.push_back(list.count[k] < 2.0 ? std::nan("")
                                            : std::sqrt(list.squares[k] / (list.count[k] - 1.0)));
  return deviation;
}

void add_member(ListAverages& averages, const MemberLists& lists, double theta_c, double spacing) {
  if (lists.theta.empty()) return;
  if (averages.over_tilt.empty()) averages.bins = lists.bins;
  if (!same_bins(averages.bins, lists.bins)) return;
  add_at(averages.over_tilt, lists, grid_up_to(lists.theta.back(), spacing));
  if (std::isnan(theta_c)) return;
  std::vector<double> tilts;
  for (const double angle_left : grid_up_to(theta_c, spacing)) tilts.push_back(theta_c - angle_left);
  add_at(averages.before_failure, lists, tilts);
}

}  // namespace talus::ensemble
