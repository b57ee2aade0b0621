#pragma once
/// Selected grains as a table, for the window and for files.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "view/grain_quantities.h"
#include "view/plots.h"

namespace talus::view {

/// The values of some grains that have one; `values` of all grains, by their ids.
std::vector<double> known_values(std::span<const Index> grains, std::span<const double> values);

/// The grains by ascending values, or descending ones; those without a value come last, and equal ones by
/// their ids.
std::vector<Index> sorted_by(std::vector<Index> grains, std::span<const double> values, bool descending);

/// "histogram of NAME": the probability densities of a quantity over the selected grains and over `all`, in
/// equal bins between the least and the largest value of all; curves are stairs. Empty where there are no
/// values.
Plot histogram_of(const analysis::GrainNumber& number, std::span<const Index> selected,
                  std::span<const Index> all, std::span<const double> values);

/// A table of the grains in CSV: time, tilt, and columns of numbers, whose heads have the units.
/// `values_of` has the values of all grains, by their ids; an empty field where there is no value.
std::string grains_table(
    const Frame& frame, std::span<const Index> grains, std::span<const analysis::GrainNumber> numbers,
    const std::function<const std::vector<double>&(const analysis::GrainNumber&)>& values_of);

}  // namespace talus::view
