#pragma once
/// A bed as a table of text: one grain a line.

#include <cstddef>
#include <string>
#include <vector>

#include "scenario/scenario.h"

namespace talus::session {

/// A line of a table. Lengths in m.
struct TableGrain {
  double x = 0.0, y = 0.0;  ///< centre; y from the top of the floor
  double radius = 0.0;      ///< > 0
  std::size_t line = 0;     ///< where it stands, from 1
};

/// A length in m; `mean_diameter` in m.
double in_metres(double length, scenario::LengthUnit unit, double mean_diameter);

/// The grains of a table of text in UTF-8, one in each line: x, y and radius, or the columns that the first
/// line names (or the last comment before the grains, if it names them all), in any order: x, y or z, and the
/// radius or the diameter. A name may have the unit of its column, "x [mm]"; columns of other names are
/// skipped. Values are separated by semicolons, commas or white space, and may be quoted; what follows a #
/// is a comment. Columns without a unit are in `unit`. `name` is what messages call the table. Throws
/// LocatedError(bad_data) with the first place that cannot be read, or that names another unit than `unit`
/// (D, the default, gives way to it).
std::vector<TableGrain> parse_bed_table(const std::string& text, const std::string& name,
                                        scenario::LengthUnit unit, double mean_diameter);

}  // namespace talus::session
