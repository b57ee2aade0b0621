#pragma once
/// What is known of each grain of a frame, in one table: names for conditions, tables and files. A name that
/// `talus export` has as well means the same there, but for the unit: as in other tables of Talus, lengths
/// are in mean diameters D, and angles in degrees (quantities.h). docs/view.md is compared with it by a test.

#include <span>
#include <string_view>
#include <vector>

#include "analysis/clusters.h"
#include "analysis/coarse_graining.h"
#include "core/bed_frame.h"
#include "view/expression.h"

namespace talus {

/// What the quantities follow from.
struct GrainSource {
  const Frame& stored;  ///< with the gamma of single grains
  const Frame& mapped;  ///< with the gamma of neighbourhoods
  const Frame* first;   ///< of the run; null where there is none yet
  const RunStatics& statics;
  const Clusters& clusters;  ///< of the overloaded grains
  CoarseGrainingRule rule;   ///< how overloaded grains and their l_c are found
};

struct GrainQuantity {
  std::string_view name;
  std::string_view unit;  ///< "D", "deg", SI, or "1"
  std::string_view definition;
  bool whole = false;  ///< its values are integers
  bool flag = false;   ///< 1 or 0
  /// Of all grains, floor included, by their ids; NaN where there is no value.
  std::vector<double> (*values)(const GrainSource& of) = nullptr;
};

std::span<const GrainQuantity> grain_quantities();

/// The row of a name. Throws Error(internal) where there is none.
const GrainQuantity& grain_quantity(std::string_view name);

/// "gamma", or "y (D)": a head of a table.
std::string head_of(const GrainQuantity& quantity);

/// All names, for parse_condition.
const std::vector<ExpressionName>& grain_names();

/// The free grains of which a condition holds, by ascending ids.
std::vector<Index> grains_where(const Expression& condition, const GrainSource& of);

}  // namespace talus
