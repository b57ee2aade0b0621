#pragma once
/// The keys of the parameters of an analysis: `--set key=value` of `talus analyze` and docs/analysis.md go by
/// their table.

#include <string>
#include <vector>

#include "analysis/parameters.h"
#include "core/snapshot.h"
#include "scenario/key.h"

namespace talus::runs {

using AnalysisKey = scenario::Key<analysis::AnalysisParameters>;

const std::vector<AnalysisKey>& analysis_keys();

/// The parameters with "key=value" settings on the defaults. Throws LocatedError(bad_data) with a line for
/// each setting that is not accepted.
analysis::AnalysisParameters parse_analysis_settings(const std::vector<std::string>& settings);

/// Names and values of all parameters, in the order of their table.
Facts as_facts(const analysis::AnalysisParameters& parameters);
/// The parameters of such a list, as an analysis has it. Throws as parse_analysis_settings does.
analysis::AnalysisParameters from_facts(const Facts& facts);

}  // namespace talus::runs
