#pragma once
/// The analysis of a whole run: every frame, and what follows from their series.

#include <functional>
#include <string>

#include "io/analysis_record.h"
#include "io/run_file.h"
#include "session/analysis_parameters.h"

namespace talus {

/// What decides whether a stored analysis is still valid: the XXH3 of the state hash of the run, all
/// parameters and analysis_version, 16 hexadecimal digits.
std::string analysis_key(const RunFile& run, const AnalysisParameters& parameters);

/// An analysis of `frames` frames with its parameters, thresholds and axes set, and no frame yet. `theta_c`
/// in rad, NaN where the slope has not failed; without it and without gamma_c there are no thresholds (F =
/// 0).
Analysis begin_analysis(const RunStatics& statics, const AnalysisParameters& parameters, double theta_c,
                        std::size_t frames);

/// Called after each frame with the number of frames that are done; may be empty.
using AnalysisProgress = std::function<void(std::size_t done)>;

/// Reads the frames one by one, on each thread, and returns all data sets of analysis_schema(). Those that
/// need a threshold are left out where the slope has not failed and no gamma_c is given. The same for any
/// number of threads. Throws Error(bad_data) where the run has no frames, and as RunFile::frame does.
Analysis analyse_run(const RunFile& run, const AnalysisParameters& parameters, int threads,
                     const AnalysisProgress& progress);

}  // namespace talus
