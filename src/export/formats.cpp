#include "export/formats.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>

#include "core/text.h"

namespace talus {
namespace {

constexpr auto entries = std::to_array<FormatEntry>({
    {ExportFormat::paraview, "paraview", "ParaView", ExportOutput::folder, "",
     "grains.pvd and contacts.pvd over time, with grains as points and contacts as lines"},
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

}  // namespace talus
