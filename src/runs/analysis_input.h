#pragma once
/// Input of the analysis from a frame of a run.

#include <cstddef>

#include "analysis/parameters.h"
#include "io/run_file.h"

namespace talus::runs {

/// Returns frame k of a run with the gamma of with_analysed_gamma. With `averaging`, internal moments are
/// means over the consecutive frames around k whose tilts differ by at most half of it, and gamma is that of
/// the means; contacts and positions remain those of frame k. A frame of the flow after failure is not
/// averaged. Not thread-safe. Throws as RunFile::frame does.
Frame analysed_frame(const io::RunFile& run, const analysis::AnalysisParameters& parameters, std::size_t k);
/// Does the same with frame k already read.
Frame analysed_frame(const io::RunFile& run, const analysis::AnalysisParameters& parameters, std::size_t k,
                     Frame frame);

}  // namespace talus::runs
