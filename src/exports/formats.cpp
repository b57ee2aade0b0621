#include "exports/formats.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>

#include "base/text.h"

namespace talus::exports {
namespace {

constexpr auto entries = std::to_array<FormatEntry>({
    {ExportFormat::paraview, "paraview", "ParaView", ExportOutput::folder, "",
     "grains.pvd and contacts.pvd over time, with grains as points and contacts as lines"},
    {ExportFormat::vti, "vti", "ParaView", ExportOutput::folder, "",
     "fields.pvd over time, with density, momentum, stress and strain rate of the bed as a continuum on a "
     "grid"},
    {ExportFormat::xyz, "xyz", "OVITO and ASE", ExportOutput::file, ".xyz",
     "grains of all frames as extended XYZ, lengths in D"},
    {ExportFormat::lammps, "lammps", "OVITO", ExportOutput::file, ".dump",
     "grains of all frames as the text of a LAMMPS dump"},
    {ExportFormat::csv, "csv", "pandas, R and spreadsheets", ExportOutput::folder, "",
     "frames.csv, grains.csv and contacts.csv, one row for each"},
    {ExportFormat::observables, "observables", "pandas, R and spreadsheets", ExportOutput::file, ".csv",
     "observables of the tilt as CSV, one row for each time at which they were recorded", false},
    {ExportFormat::html, "html", "web browsers", ExportOutput::file, ".html",
     "one page with maps, time line and curves, readable without Talus or a network", true, true},
});

}  // namespace

std::span<const FormatEntry> export_formats() { return entries; }

const FormatEntry& entry_of(ExportFormat format) {
  return *std::ranges::find(entries, format, &FormatEntry::format);
}

std::optional<ExportFormat> export_format(std::string_view name) {
  const auto entry = std::ranges::find(entries, name, &FormatEntry::name);
  return entry == entries.end() ? std::nullopt : std::optional(entry->format);
}

std::string list_of_formats() {
  return joined(entries, "; ", [](const FormatEntry& entry) {
    return fmt::format("{}: {}, for {}", entry.name, entry.help, entry.program);
  });
}

}  // namespace talus::exports
