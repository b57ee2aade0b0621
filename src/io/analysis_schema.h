#pragma once
/// The data sets of the analysis of a run, /analysis in its file: a version, a key, parameters as texts, and
/// the table of quantities.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/quantities.h"
#include "io/run_schema.h"

namespace talus::io {

/// Increases with each change of the table or of the computation; stored analyses of other versions are
/// recomputed.
inline constexpr std::int32_t analysis_version = 8;

/// Returns the data set of a quantity.
DataSetField data_set_of(const analysis::Quantity& quantity);

/// Returns all data sets, in the order in which they are written.
std::vector<DataSetField> analysis_schema(std::span<const analysis::Quantity> table = analysis::quantities());

/// Returns "/analysis/lc/mean" for "lc/mean".
std::string analysis_path(std::string_view name);

/// Returns the letters of the shapes for an analysis of at least one frame.
Sizes sizes_of(const analysis::Analysis& analysis);

/// Whether an analysis contains the quantity; some need a threshold or events.
bool is_present(const analysis::Quantity& quantity, const analysis::Analysis& analysis);

}  // namespace talus::io
