#pragma once
/// A figure as data: its tables, its maps, and what they were made from. A gnuplot script of the same name,
/// assets/figures/NAME.gp, draws it, unless it is a panel of maps; nothing here draws.

#include <fmt/core.h>
#include <string>
#include <utility>
#include <vector>

#include "render/frame_view.h"

namespace talus::figures {

/// A column of numbers; NaN where there is none.
struct Column {
  std::string name;  ///< "p_o", as the script and readers of the CSV file call it
  std::string unit;  ///< "deg", "D", "1"
  std::string meaning;
  std::vector<double> values;
};

/// One CSV file beside the figure: FIGURE.csv, or FIGURE-NAME.csv where it has a name. Columns are of equal
/// length.
struct Table {
  std::string name;
  std::vector<Column> columns;
  bool in_blocks = false;  ///< an empty line wherever the first column changes: gnuplot begins another curve
};

struct Figure {
  std::string name;     ///< "fig09-overloaded-fraction": that of its script and of all its files
  std::string title;    ///< "Overloaded fraction over tilt (paper, Fig. 9)"
  std::string caption;  ///< what is shown, with the number of runs behind it and what error bars are
  std::vector<std::string> runs;  ///< paths of the runs that it was made from
  bool wide = false;              ///< made for two columns (17.8 cm) rather than one (8.6 cm)
  double height_over_width = 0.75;
  std::vector<Table> tables;
  std::size_t groups = 0;  ///< groups of runs that have a table
  /// A figure of maps, which no script draws: a row for each frame, a column for each map.
  std::vector<std::vector<render::FrameView>> maps;
  /// What the script has to know beside the tables: gnuplot names and values ("gamma_c", "0.23"; texts in
  /// double quotes).
  std::vector<std::pair<std::string, std::string>> variables;
  std::string script = {};  ///< of assets/figures; empty: that of its name
};

/// The file of a table, beside those of the figure.
inline std::string file_of(const Figure& figure, const Table& table) {
  return fmt::format("{}{}{}.csv", figure.name, table.name.empty() ? "" : "-", table.name);
}

}  // namespace talus::figures
