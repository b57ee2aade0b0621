#pragma once
/// Every data set of the analysis of a run, /analysis in its file, in one table: as run_schema.h for the run
/// itself. docs/analysis.md is compared with it by a test.

#include <string>
#include <string_view>
#include <vector>

#include "io/run_schema.h"

namespace talus {

/// Counts up with each change of the table or of what is computed: stored analyses of other versions are
/// computed again.
inline constexpr std::int32_t analysis_version = 3;

struct AnalysisField {
  DataSetField data_set;
  std::string parameters;  ///< names of those that it depends on, with blanks between; may be empty
};

const std::vector<AnalysisField>& analysis_schema();

/// "theta_d/dilation" for "/analysis/theta_d/dilation", and back.
std::string analysis_name(const AnalysisField& field);
std::string analysis_path(std::string_view name);

/// Whether it is a number or an array of numbers that make_analysis makes; the few texts and the version
/// have places of their own.
bool is_array(const AnalysisField& field);

/// Whether an analysis of these sizes has it: what needs a threshold is not there for F = 0.
bool is_present(const AnalysisField& field, const Sizes& sizes);

}  // namespace talus
