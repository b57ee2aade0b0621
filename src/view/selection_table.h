#pragma once
/// Table of the selected grains, for the window and for files.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "view/grain_quantities.h"
#include "view/plots.h"

namespace talus::view {

/// Returns the values of those grains that have one; `values` is indexed by id.
std::vector<double> known_values(std::span<const Index> grains, std::span<const double> values);

/// Returns the grains in ascending or descending order of their values. Grains without a value come last;
/// equal values are ordered by id.
std::vector<Index> sorted_by(std::vector<Index> grains, std::span<const double> values, bool descending);

/// Returns the plot "histogram of NAME": the probability densities of a quantity over the selected grains and
/// over `all`, in equal bins between the smallest and the largest value of all. Curves are steps. Empty
/// without values.
Plot histogram_of(const analysis::GrainNumber& number, std::span<const Index> selected,
                  std::span<const Index> all, std::span<const double> values);

/// Returns a CSV table of the grains: time, tilt, and columns of values with units in their headings.
/// `values_of` returns the values of all grains, indexed by id; a missing value is an empty field.
std::string grains_table(
    const Frame& frame, std::span<const Index> grains, std::span<const analysis::GrainNumber> numbers,
    const std::function<const std::vector<double>&(const analysis::GrainNumber&)>& values_of);

}  // namespace talus::view
