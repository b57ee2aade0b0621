#pragma once
/// Text files of a figure: data, provenance, and the script that draws it.

#include <span>
#include <string>

#include "figures/figure.h"
#include "figures/run_group.h"

namespace talus::app {

/// Returns column names and a line for each row, with the shortest digits that read back as the same number,
/// and NaN for missing values. Blocks of a table are separated by an empty line, which CSV readers skip.
std::string csv_text(const figures::Table& table);

/// Returns content and sources of a figure: title, caption, version, command line; runs with seed, state
/// hash, scenario hash and parameters of the analysis; name, unit and meaning of each column of its tables.
std::string provenance_json(const figures::Figure& figure, std::span<const figures::RunGroup> groups,
                            const std::string& command_line);

/// Widths of one and two journal columns, cm.
inline constexpr double column_widths[] = {8.6, 17.8};
/// Size of a figure, cm; 0: its default.
struct FigureSize {
  double width = 0.0;
  double height = 0.0;
};
/// Returns the width of a figure for a requested size, cm.
double figure_width(const figures::Figure& figure, const FigureSize& size);

/// Returns a script that needs only the tables and maps in its folder: the figure's variables, the common
/// style and its own script. It draws FIGURE.pdf, FIGURE.svg and FIGURE.png in the folder in which it is run.
std::string gnuplot_text(const figures::Figure& figure, const FigureSize& size = {});

}  // namespace talus::app
