#pragma once
/// A frame of a run as its analysis sees it.

#include <cstddef>

#include "analysis/parameters.h"
#include "io/run_file.h"

namespace talus::runs {

/// Frame k of a run. With `averaging`, internal moments are means over the frames in a row around k whose
/// tilt is at most half of it away, and gamma is that of the mean; contacts and places stay those of frame k.
/// A frame of the flow after failure is not averaged. Then gamma is that of with_analysed_gamma. Not for
/// several threads at once. Throws as RunFile::frame does.
Frame analysed_frame(const io::RunFile& run, const analysis::AnalysisParameters& parameters, std::size_t k);
/// The same where frame k was read already.
Frame analysed_frame(const io::RunFile& run, const analysis::AnalysisParameters& parameters, std::size_t k,
                     Frame frame);

}  // namespace talus::runs
