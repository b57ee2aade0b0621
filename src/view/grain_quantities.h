#pragma once
/// Conditions on the values of grains (frame_quantities.h).

#include <vector>

#include "analysis/frame_quantities.h"
#include "view/expression.h"

namespace talus::view {

/// Returns the heading of a column: "gamma", or "y (D)".
std::string head_of(const analysis::GrainNumber& number);

/// Returns all names, for parse_condition.
const std::vector<ExpressionName>& grain_names();

/// Returns the free grains that satisfy a condition, in ascending order of id.
std::vector<Index> grains_where(const Expression& condition, const analysis::GrainSource& source);

}  // namespace talus::view
