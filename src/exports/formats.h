#pragma once
/// The export formats, in one table that --help, messages and docs/export.md follow.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace talus::exports {

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
  std::string_view ending;  ///< extension of the file name; empty for a folder
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

}  // namespace talus::exports
