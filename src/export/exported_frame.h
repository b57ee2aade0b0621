#pragma once
/// What the writers of all formats are given: a frame of a run, with what its analysis says of each grain.

#include <cstddef>
#include <vector>

#include "analysis/parameters.h"
#include "analysis/record.h"
#include "core/snapshot.h"
#include "io/run_file.h"

namespace talus {

/// What all frames of a run have in common.
struct ExportedRun {
  RunStatics statics;
  AnalysisParameters parameters;
  Analysis analysis;  ///< its thresholds; without frames
  Frame first;        ///< of it x, y and image, from which displacements are measured
};

struct ExportedFrame {
  const ExportedRun& run;
  std::size_t number = 0;                  ///< in the run, counted from 0
  Frame frame;                             ///< as it is stored
  std::vector<double> gamma;               ///< of the neighbourhood of each grain, as its analysis has it
  std::vector<FrameThreshold> thresholds;  ///< in the order of those of the run
};

/// Throws Error(bad_data) where the run has no frames.
ExportedRun exported_run(const RunFile& file, const AnalysisParameters& parameters);

/// Frame k, which may be one of the flow after failure. Throws as RunFile::frame does.
ExportedFrame exported_frame(const RunFile& file, const ExportedRun& run, std::size_t k);

}  // namespace talus
