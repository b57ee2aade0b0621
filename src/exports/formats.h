#pragma once
/// The formats that runs are exported to, in one table: --help, messages and docs/export.md go by it.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace talus::exports {

enum class ExportFormat { paraview, vti, xyz, lammps, graphml, csv, observables, html };

/// What the output of a format is called.
enum class ExportOutput {
  folder,          ///< a folder of files
  file,            ///< one file of all frames
  file_per_frame,  ///< one file; a folder of them where there are several frames
};

struct FormatEntry {
  ExportFormat format;
  std::string_view name;     ///< as in --to
  std::string_view program;  ///< who reads it
  ExportOutput output;
  std::string_view ending;  ///< of the name of a file; empty for a folder
  std::string_view help;    ///< a line for users: what is written
  bool has_frames = true;
  bool needs_analysis = false;  ///< of the whole run
};

/// All of them, in the order in which they are listed to users.
std::span<const FormatEntry> export_formats();
const FormatEntry& entry_of(ExportFormat format);
std::optional<ExportFormat> export_format(std::string_view name);
/// "paraview: a folder ..., for ParaView; ...", of all.
std::string list_of_formats();

}  // namespace talus::exports
