#pragma once
/// Averages of distributions, correlations and tensors over the members of an ensemble, at each angle of a
/// grid. Members are added one by one and not kept, so that memory does not grow with their number.

#include <cstddef>
#include <string>
#include <vector>

#include "ensemble/member_values.h"

namespace talus::ensemble {

/// A list of numbers at each point of a grid, averaged over the members that have it there.
struct AveragedList {
  std::string name, unit, definition;
  std::size_t width = 0;
  std::vector<double> count{};    ///< n, points x width
  std::vector<double> mean{};     ///< NaN if n = 0
  std::vector<double> squares{};  ///< sum of squared deviations from the mean
};

/// Returns the standard deviation (n - 1) of each number at each point; NaN if n < 2.
std::vector<double> deviation_of(const AveragedList& list);

struct ListAverages {
  std::vector<NamedList> bins;               ///< edges and centres of bins, identical for all members
  std::vector<AveragedList> over_tilt;       ///< grid of multiples of the spacing
  std::vector<AveragedList> before_failure;  ///< grid of the same multiples of theta_c - theta
};

/// Adds a member. `theta_c` is the member's, deg, or NaN; `spacing` is that of the grid, deg. Lists are
/// interpolated number by number between two frames. A member whose bins differ from those of the first one
/// is ignored. Rounding makes means depend on the order of the members: add them in the order of their seeds.
void add_member(ListAverages& averages, const MemberLists& lists, double theta_c, double spacing);

}  // namespace talus::ensemble
