#pragma once
/// A bed as a table of text: one grain a line.

#include <cstddef>
#include <string>
#include <vector>

namespace talus {

/// A line of a table. Lengths in mean diameters D.
struct TableGrain {
  double x = 0.0, y = 0.0;  ///< centre; y from the top of the floor
  double radius = 0.0;      ///< > 0
  std::size_t line = 0;     ///< where it stands, from 1
};

/// The grains of a table, `x,y,radius` in each line, with commas or white space between the numbers; empty
/// lines, what follows a #, and a first line with the names of the columns hold no grain. `name` is what
/// messages call the table. Throws LocatedError(bad_data) with the first place that cannot be read.
std::vector<TableGrain> parse_bed_table(const std::string& text, const std::string& name);

}  // namespace talus
