#pragma once
/// A frame as its analysis sees it: which moments grains have, and which grains count.

#include <cstddef>

#include "io/run_file.h"
#include "session/analysis_parameters.h"

namespace talus {

/// The frame with the gamma by which grains count. With `min_contacts` above 1, gamma of a free grain with
/// fewer force-carrying contacts is NaN, as if it carried nothing; its moment stays. Then gamma is that of
/// the neighbourhood of diameter `l_min` of each grain (with_gamma_of_neighbourhoods).
Frame with_analysed_gamma(Frame frame, const RunStatics& statics, const AnalysisParameters& parameters);

/// Frame k of a run. With `averaging`, internal moments are means over the frames in a row around k whose
/// tilt is at most half of it away, and gamma is that of the mean; contacts and places stay those of frame k.
/// Then gamma is that of with_analysed_gamma. Not for several threads at once. Throws as RunFile::frame does.
Frame analysed_frame(const RunFile& run, const AnalysisParameters& parameters, std::size_t k);

}  // namespace talus
