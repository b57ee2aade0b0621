#pragma once
/// A figure as data: its tables, its maps, and its source runs. A gnuplot script of the same name,
/// assets/figures/NAME.gp, draws it, unless it is a panel of maps; this module does not draw.

#include <fmt/core.h>
#include <string>
#include <utility>
#include <vector>

#include "render/frame_view.h"

namespace talus::figures {

/// A column of numbers; NaN for a missing value.
struct Column {
  std::string name;  ///< "p_o", used by the script and in the CSV file
  std::string unit;  ///< "deg", "D", "1"
  std::string meaning;
  std::vector<double> values;
};

/// A CSV file next to the figure: FIGURE.csv, or FIGURE-NAME.csv if the table has a name. Columns have equal
/// length.
struct Table {
  std::string name;
  std::vector<Column> columns;
  /// An empty line at each change of the first column starts another curve in gnuplot.
  bool in_blocks = false;
};

/// A figure with its tables or maps.
struct Figure {
  std::string name;     ///< "fig09-overloaded-fraction", also the name of its script and of all its files
  std::string title;    ///< "Overloaded fraction over tilt (paper, Fig. 9)"
  std::string caption;  ///< content of the figure, with the number of runs and the meaning of error bars
  std::vector<std::string> runs;  ///< paths of the source runs
  bool wide = false;              ///< two columns wide (17.8 cm) rather than one (8.6 cm)
  double height_over_width = 0.75;
  std::vector<Table> tables;
  std::size_t groups = 0;  ///< number of groups of runs that have a table
  /// Maps of a figure that no script draws: a row for each frame, a column for each map.
  std::vector<std::vector<render::FrameView>> maps;
  /// Further input of the script: gnuplot variables and values ("gamma_c", "0.23"; texts in double quotes).
  std::vector<std::pair<std::string, std::string>> variables;
  std::string script = {};  ///< name in assets/figures; empty: the name of the figure
};

/// Returns the name of the file of a table, next to those of the figure.
inline std::string file_of(const Figure& figure, const Table& table) {
  return fmt::format("{}{}{}.csv", figure.name, table.name.empty() ? "" : "-", table.name);
}

}  // namespace talus::figures
