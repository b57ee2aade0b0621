#pragma once
/// The text files of a figure: data, provenance, and the script that draws it.

#include <span>
#include <string>

#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus::app {

/// Column names, then a line for each row; the shortest digits that read back as the same number, NaN as NaN.
/// Between blocks, where the table has them, there is an empty line, which readers of CSV pass over.
std::string csv_text(const figures::Table& table);

/// What a figure shows and was made from: title, caption, version, command line, runs with seed, state hash,
/// scenario hash and parameters of the analysis, and name, unit and meaning of each column of its tables.
std::string provenance_json(const figures::Figure& figure, std::span<const figures::RunGroup> groups,
                            const std::string& command_line);

/// cm; of one column of a journal and of two.
inline constexpr double column_widths[] = {8.6, 17.8};
/// cm; 0: the figure's own.
struct FigureSize {
  double width = 0.0;
  double height = 0.0;
};
/// The width of a figure in that size, cm.
double figure_width(const figures::Figure& figure, const FigureSize& size);

/// A script that needs nothing but the tables and maps beside it: the figure's variables, the common style
/// and its own script. It draws FIGURE.pdf, FIGURE.svg and FIGURE.png in the folder where it is run.
std::string gnuplot_text(const figures::Figure& figure, const FigureSize& size = {});

}  // namespace talus::app
