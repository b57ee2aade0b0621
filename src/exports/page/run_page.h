#pragma once
/// A run as a single self-contained HTML page, readable without Talus: maps, time line, curves and texts.
/// docs/export.md describes the page; its source is in assets/page.

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/record.h"
#include "core/watch.h"
#include "io/run_file.h"

namespace talus::exports {

/// Returns the page of these frames (indices in the run, ascending) of the run file at `path`, whose name is
/// in the title; `analysis` is that of the entire run. The same run, frames and analysis give the same bytes.
/// Throws Error(stopped) if it was stopped, and the errors of RunFile::frame.
std::string run_page(const io::RunFile& file, const std::string& path, const analysis::Analysis& analysis,
                     const std::vector<std::size_t>& frames, const Watch& watch);

}  // namespace talus::exports
