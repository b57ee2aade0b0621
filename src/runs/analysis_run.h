#pragma once
/// Analysis of an entire run: the input from each of its frames, and quantities that follow from their
/// series.

#include <cstddef>
#include <functional>
#include <string>

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

/// Returns frame k of a run with the gamma of with_analysed_gamma. With `averaging`, internal moments are
/// means over the consecutive frames around k whose tilts differ by at most half of it, and gamma is that of
/// the means; contacts and positions remain those of frame k. A frame of the flow after failure is not
/// averaged. Not thread-safe. Throws as RunFile::frame does.
Frame analysed_frame(const io::RunFile& run, const analysis::AnalysisParameters& parameters, std::size_t k);
/// Does the same with frame k already read.
Frame analysed_frame(const io::RunFile& run, const analysis::AnalysisParameters& parameters, std::size_t k,
                     Frame frame);

}  // namespace talus::runs
