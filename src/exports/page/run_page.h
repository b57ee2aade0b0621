#pragma once
/// A run as one page of HTML, for those without Talus: maps, time line, curves and texts, with all that it
/// needs inside. docs/export.md says what a reader sees; assets/page has its source.

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/record.h"
#include "core/watch.h"
#include "io/run_file.h"

namespace talus::exports {

/// The page of these frames (numbers in the run, ascending) of the run file at `path`, of which its title
/// has the name; `analysis` is that of the whole run. The same bytes for the same run, frames and analysis.
/// Throws Error(stopped) where it was stopped, and as RunFile::frame does.
std::string run_page(const io::RunFile& file, const std::string& path, const analysis::Analysis& analysis,
                     const std::vector<std::size_t>& frames, const Watch& watch);

}  // namespace talus::exports
