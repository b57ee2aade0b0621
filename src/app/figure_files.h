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

/// Returns the names of the files of an earlier figure of this name in a folder, as its provenance lists
/// them; none without a provenance.
std::vector<std::string> earlier_figure_files(const std::string& folder, const std::string& name);

/// Removes what an earlier figure of this name has left in a folder, except the files of `names`.
void remove_earlier_figure(const std::string& folder, const std::vector<std::string>& earlier,
                           const std::vector<std::string>& names = {});

/// Writes all files of a figure into a folder, which is created if missing. Existing files are replaced
/// (output_target asks beforehand), and further files of an earlier figure of this name are removed. The
/// files are made in a temporary folder and renamed when all are complete, the provenance last. `groups` hold
/// the runs of the figure. Throws Error(unavailable) without gnuplot or a rendering context,
/// Error(cannot_create), and Error(io_error) with the message of gnuplot.
void write_figure(const figures::Figure& figure, std::span<const figures::RunGroup> groups,
                  const std::string& folder, const FigureOptions& options);

}  // namespace talus::app
