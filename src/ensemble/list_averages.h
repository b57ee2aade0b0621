#pragma once
/// Averages of distributions, correlations and tensors over the members of an ensemble, at each angle of a
/// grid. Members are added one by one and not kept, so that the memory does not grow with their number.

#include <cstddef>
#include <string>
#include <vector>

#include "ensemble/member_values.h"

namespace talus::ensemble {

/// A list of numbers at each point of a grid: of the members that have it there.
struct AveragedList {
  std::string name, unit, definition;
  std::size_t width = 0;
  std::vector<double> count{};    ///< n, point by point, in each number by number
  std::vector<double> mean{};     ///< NaN where n = 0
  std::vector<double> squares{};  ///< sum of the squared deviations from the mean
};

/// Standard deviation with n - 1, of each number at each point; NaN where n < 2.
std::vector<double> deviation_of(const AveragedList& list);

struct ListAverages {
  std::vector<NamedList> bins;               ///< edges and middles of bins, the same for all members
  std::vector<AveragedList> over_tilt;       ///< at multiples of the spacing
  std::vector<AveragedList> before_failure;  ///< at such angles left to theta_c
};

/// Adds a member. `theta_c`: of it, deg, or NaN; `spacing` of the grid, deg. Between two frames lists are
/// interpolated, number by number. A member whose bins are others than those of the first does not count.
/// Means depend on the order of the members by rounding: add them in the order of their seeds.
void add_member(ListAverages& averages, const MemberLists& lists, double theta_c, double spacing);

}  // namespace talus::ensemble
