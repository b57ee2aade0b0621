#pragma once
/// Frames of a run as files of a format.

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/parameters.h"
#include "core/watch.h"
#include "export/formats.h"
#include "io/run_file.h"

namespace talus {

struct ExportPlan {
  ExportFormat format = ExportFormat::paraview;
  std::string output;               ///< file or folder
  std::vector<std::size_t> frames;  ///< numbers in the run, ascending
  AnalysisParameters parameters;    ///< of overloaded grains, their lengths and clusters
};

/// The files that a plan writes. Throws Error(usage) where the name of the output does not fit the format.
std::vector<std::string> files_of(const ExportPlan& plan);

/// Writes them, each whole or not at all, and makes the folder where it is missing. Frames are read one by
/// one. Throws Error(stopped) where it was stopped, Error(bad_data) where the run has no frames, and as
/// RunFile::frame and write_text do.
void export_files(const RunFile& run, const ExportPlan& plan, const Watch& watch);

}  // namespace talus
