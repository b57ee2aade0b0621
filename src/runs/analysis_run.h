#pragma once
/// Analysis of an entire run: all frames, and quantities that follow from their series.

#include <functional>
#include <string>

#include "analysis/parameters.h"
#include "analysis/record.h"
#include "io/run_file.h"

namespace talus::runs {

/// Returns the key by which a stored analysis is recognised as valid: the XXH3 hash of the state hash of the
/// run, all parameters and analysis_version, 16 hexadecimal digits.
std::string analysis_key(const io::RunFile& run, const analysis::AnalysisParameters& parameters);

/// Callback after each frame with the number of completed frames; may be empty.
using AnalysisProgress = std::function<void(std::size_t done)>;

/// Reads the frames one by one and computes all quantities, with the same result for any number of threads.
/// There are no thresholds if the slope has not failed and no gamma_c is given. Throws Error(bad_data) if the
/// run has no frames, and as RunFile::frame does.
analysis::Analysis analyse_run(const io::RunFile& run, const analysis::AnalysisParameters& parameters,
                               int threads, const AnalysisProgress& progress);

}  // namespace talus::runs
