#pragma once
/// Exports frames of a run to files of a format. The room has two nouns: a plan names the format, the frames
/// and the output; a writer (writers.h) returns one frame, or the whole HTML page, as text. page/page_data.h
/// has the contents of that page.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/record.h"
#include "core/types.h"
#include "io/run_file.h"

namespace talus::exports {

/// The export formats, in one table that --help, messages and docs/export.md follow.
enum class ExportFormat { paraview, vti, xyz, lammps, csv, observables, html };

/// The kind of output of a format.
enum class ExportOutput {
  folder,  ///< a folder of files
  file,    ///< one file with all frames
};

struct FormatEntry {
  ExportFormat format;
  std::string_view name;     ///< name in --to
  std::string_view program;  ///< programs that read it
  ExportOutput output;
  std::string_view ending;  ///< extension of the file, or of the files in the folder
  std::string_view help;    ///< one line of help: the contents
  bool has_frames = true;
  bool needs_analysis = false;  ///< needs the analysis of the entire run
};

/// Returns all formats, in the order in which they are listed to users.
std::span<const FormatEntry> export_formats();
const FormatEntry& entry_of(ExportFormat format);
std::optional<ExportFormat> export_format(std::string_view name);
/// Returns a list of all formats: "paraview: a folder ..., for ParaView; ...".
std::string list_of_formats();

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

/// Throws Error(usage) if the format writes one file and `output` does not have its extension, or if it
/// writes a folder and `output` has that of a file.
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
