#pragma once
/// Frames of a run as files of a format.

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
  std::vector<std::size_t> frames;  ///< numbers in the run, ascending; none where the format has no frames
  bool flow = false;                ///< where it has none: also what was observed after failure
  analysis::AnalysisParameters parameters;  ///< of overloaded grains, their lengths and clusters
  double field_width = 10.0;                ///< D: diameter of the coarse-graining function of vti
  std::string run;                          ///< path of the run, where a format tells its name
  analysis::Analysis analysis;              ///< of the run by these parameters, where the format needs it
};

/// Throws Error(usage) where a format that writes one file has another ending than the name of the output.
void check_output_name(ExportFormat format, const std::string& output);

/// The files that a plan writes. Throws Error(usage) where there are several frames, each in a file of its
/// own, and the output is the name of one file.
std::vector<std::string> files_of(const ExportPlan& plan);

/// Writes them, each whole or not at all, and makes the folder where it is missing. Frames are read one by
/// one. Returns how many frames there are, or rows of observables. Throws Error(stopped) where it was
/// stopped, Error(bad_data) where the run has no frames, and as RunFile::frame and write_text do.
std::size_t export_files(const io::RunFile& run, const ExportPlan& plan, const Watch& watch);

}  // namespace talus::exports
