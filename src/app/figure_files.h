#pragma once
/// Files of figures: CSV, JSON, maps, and the drawings of gnuplot.

#include <span>
#include <string>
#include <vector>

#include "app/figure_text.h"
#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus::app {

struct FigureOptions {
  FigureSize size{};
  std::string command_line{};  ///< command line of the program, for the provenance
};

/// Returns the names of all files of a figure: drawings, tables, maps, script and provenance.
std::vector<std::string> figure_files(const figures::Figure& figure);

/// Writes all files of a figure into a folder, which is created if missing. Existing files are replaced
/// (refuse_existing asks beforehand). The files are made in a temporary folder and renamed when all are
/// complete, the provenance last. `groups` hold the runs of the figure. Throws Error(unavailable) without
/// gnuplot or a rendering context, Error(cannot_create), and Error(io_error) with the message of gnuplot.
void write_figure(const figures::Figure& figure, std::span<const figures::RunGroup> groups,
                  const std::string& folder, const FigureOptions& options);

}  // namespace talus::app
