#pragma once
/// The analysis of a whole run: every frame, and what follows from their series.

#include <functional>
#include <string>

#include "analysis/parameters.h"
#include "analysis/record.h"
#include "io/run_file.h"

namespace talus::runs {

/// What decides whether a stored analysis is still valid: the XXH3 of the state hash of the run, all
/// parameters and analysis_version, 16 hexadecimal digits.
std::string analysis_key(const io::RunFile& run, const analysis::AnalysisParameters& parameters);

/// Called after each frame with the number of frames that are done; may be empty.
using AnalysisProgress = std::function<void(std::size_t done)>;

/// Reads the frames one by one, on each thread, and finds all quantities. Where the slope has not failed and
/// no gamma_c is given there are no thresholds. The same for any number of threads. Throws Error(bad_data)
/// where the run has no frames, and as RunFile::frame does.
analysis::Analysis analyse_run(const io::RunFile& run, const analysis::AnalysisParameters& parameters,
                               int threads, const AnalysisProgress& progress);

}  // namespace talus::runs
