#pragma once
/// Conditions on the numbers of grains (frame_quantities.h).

#include <vector>

#include "analysis/frame_quantities.h"
#include "view/expression.h"

namespace talus::view {

/// "gamma", or "y (D)": a head of a table.
std::string head_of(const analysis::GrainNumber& number);

/// All names, for parse_condition.
const std::vector<ExpressionName>& grain_names();

/// The free grains of which a condition holds, by ascending ids.
std::vector<Index> grains_where(const Expression& condition, const analysis::GrainSource& of);

}  // namespace talus::view
