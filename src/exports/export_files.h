#pragma once
/// Exports frames of a run to files of a format.

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/parameters.h"
#include "analysis/record.h"
#include "core/watch.h"
#include "exports/formats.h"
#include "io/run_file.h"

namespace talus::exports {

struct ExportPlan {
  ExportFormat format = ExportFormat::paraview;
  std::string output;               ///< file or folder
  std::vector<std::size_t> frames;  ///< indices in the run, ascending; empty if the format has no frames
  bool flow = false;                ///< formats without frames: also export what was observed after failure
  analysis::AnalysisParameters parameters;  ///< parameters of overloaded grains, their lengths and clusters
  double field_width = 10.0;                ///< D: diameter of the coarse-graining function of vti
  std::string run;                          ///< path of the run, for formats that name it
  analysis::Analysis analysis;  ///< analysis of the run with these parameters, for formats that need it
};

/// Throws Error(usage) if the format writes one file and `output` does not have its extension.
void check_output_name(ExportFormat format, const std::string& output);

/// Returns the files that a plan writes. Throws Error(usage) if it has several frames, each in its own file,
/// and the output is the name of one file.
std::vector<std::string> files_of(const ExportPlan& plan);

/// Returns the files that an earlier export in this format has left in the folder of the output, and that the
/// plan does not write: they have the name of a frame and begin as Talus writes them.
std::vector<std::string> stale_files(const ExportPlan& plan);

/// Writes the files, each atomically, and creates the folder if it is missing. Frames are read one by one.
/// Returns the number of frames, or of rows of observables. Throws Error(stopped) if it was stopped,
/// Error(bad_data) if the run has no frames, and the errors of RunFile::frame and write_text.
std::size_t export_files(const io::RunFile& run, const ExportPlan& plan, const Watch& watch);

}  // namespace talus::exports
