#include "export/exported_frame.h"

#include <utility>

#include "analysis/frame_analysis.h"
#include "analysis/packing.h"
#include "core/errors.h"
#include "session/analysis_input.h"

namespace talus {
namespace {

/// The frame as its analysis sees it. Moments are averaged over frames of the tilt only.
Frame seen_by_analysis(const RunFile& file, const ExportedRun& run, const Frame& frame, std::size_t k) {
  const bool averaged = run.parameters.averaging > 0.0 && k < file.frame_count();
  return averaged ? analysed_frame(file, run.parameters, k)
                  : with_analysed_gamma(frame, run.statics, run.parameters);
}

}  // namespace

ExportedRun exported_run(const RunFile& file, const AnalysisParameters& parameters) {
  if (file.frame_count() == 0)
    throw Error(ExitCode::bad_data, "the run has no frames yet: the first is that of the bed at rest");
  const RunStatics& statics = file.header().statics;
  const double theta_c = find_value(file.checkpoint().results, "theta_c").value_or(not_known);
  return {statics, parameters, begin_analysis(statics, parameters, theta_c), file.frame(0)};
}

ExportedFrame exported_frame(const RunFile& file, const ExportedRun& run, std::size_t k) {
  ExportedFrame exported = {run, k, file.frame(k), {}, {}};
  Frame seen = seen_by_analysis(file, run, exported.frame, k);
  const BedFrame bed = {seen, run.statics};
  exported.thresholds = analyse_thresholds(bed, run.parameters, run.analysis, frame_volume(bed));
  exported.gamma = std::move(seen.gamma);
  return exported;
}

}  // namespace talus
