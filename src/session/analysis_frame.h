#pragma once
/// The analysis of one frame: the functions of the room `analysis`, into the rows of the record that is
/// stored.

#include <cstddef>

#include "core/snapshot.h"
#include "io/analysis_record.h"
#include "session/analysis_parameters.h"

namespace talus {

/// Sets what is the same for all frames: edges of bins and sections, directions.
void set_axes(const RunStatics& statics, const AnalysisParameters& parameters, Analysis& analysis);

/// Sets row k of all series of frames but those that come from the observables. Thresholds and the cut of l_c
/// are those of the record; `frame` is one of analysed_frame, made with the same parameters. Different rows
/// can be set at the same time.
void analyse_frame(const Frame& frame, const RunStatics& statics, const AnalysisParameters& parameters,
                   std::size_t k, Analysis& analysis);

}  // namespace talus
