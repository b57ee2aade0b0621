#pragma once
/// Table of the parameters of an analysis, used by `talus analyze --set key=value` and docs/analysis.md.

#include <string>
#include <vector>

#include "analysis/record.h"
#include "core/snapshot.h"
#include "scenario/key.h"

namespace talus::runs {

using AnalysisKey = scenario::Key<analysis::AnalysisParameters>;

/// Returns the table of the parameters, in the order of docs/analysis.md.
const std::vector<AnalysisKey>& analysis_keys();

/// Returns the parameters with "key=value" settings applied to the defaults. Throws LocatedError(bad_data)
/// with a line for each setting that is not accepted.
analysis::AnalysisParameters parse_analysis_settings(const std::vector<std::string>& settings);

/// Returns names and values of all parameters, in the order of their table.
Facts as_facts(const analysis::AnalysisParameters& parameters);
/// Returns the parameters from such a list, as stored with an analysis. Throws as parse_analysis_settings
/// does.
analysis::AnalysisParameters from_facts(const Facts& facts);

}  // namespace talus::runs
