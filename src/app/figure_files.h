#pragma once
/// Figures as files: CSV, JSON, maps, and what gnuplot draws of them.

#include <span>
#include <string>
#include <vector>

#include "app/figure_text.h"
#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus::app {

struct FigureOptions {
  FigureSize size{};
  std::string command_line{};  ///< of the program, for the provenance
};

/// The names of all files of a figure: what is drawn, its tables and maps, its script and its provenance.
std::vector<std::string> figure_files(const figures::Figure& figure);

/// Writes all files of a figure into a folder, which is made where it is missing. Files that exist are
/// replaced (refuse_existing asks before). They are made in a folder beside and renamed when all are whole,
/// the provenance last. `groups` hold the runs of the figure. Throws Error(unavailable) where there is no
/// gnuplot or no rendering context, Error(cannot_create), and Error(io_error) with what gnuplot said.
void write_figure(const figures::Figure& figure, std::span<const figures::RunGroup> groups,
                  const std::string& folder, const FigureOptions& options);

}  // namespace talus::app
