#pragma once
/// A bed as a table of text: one grain a line.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scenario/scenario.h"

namespace talus::session {

/// A line of a table. Lengths in m.
struct TableGrain {
  double x = 0.0, y = 0.0;  ///< centre; y from the top of the floor
  double radius = 0.0;      ///< > 0
  std::size_t line = 0;     ///< where it stands, from 1
  double z = 0.0;           ///< of the plane of the bed
  double id = 0.0;          ///< of a dump; else 0
  double frame = 0.0;       ///< as a column of this name says
};

struct BedTable {
  std::vector<TableGrain> grains;  ///< of a dump in the order of their ids, else in that of the file
  std::optional<double> period;    ///< m, of a box that is periodic along x, which begins at x = 0 then
  /// What was taken and what was not, where there was a choice: "frame 0 of 3; x and z are the plane;
  /// ignored: type, vx".
  std::string remark;
};

/// How the lengths of a file are meant.
struct LengthRule {
  scenario::LengthUnit unit = scenario::LengthUnit::mean_diameter;
  double mean_diameter = 1.0;  ///< m
  double scale = 1.0;          ///< factor on all lengths
};

/// A length in m.
double in_metres(double length, scenario::LengthUnit unit, double mean_diameter);

/// The grains of a text in UTF-8: of a frame (from 0; -1: the last) of a dump of LAMMPS or LIGGGHTS or of
/// extended XYZ, or of a table. That has one grain in each line: x, y and radius, or the columns that the
/// first line names (or the last comment before the grains, if it names them all, "#format x_y_z_r" of YADE
/// too), in any order: x, y or z, and the radius or the diameter. A name may have the unit of its column, "x
/// [mm]"; a column `frame` divides it into frames, and columns of other names are skipped. Values are
/// separated by semicolons, commas or white space, and may be quoted; what follows a # is a comment. Columns
/// without a unit are in that of `lengths`. With x, y and z, y is the height if z is the same for all, and z
/// if y is. `name` is what messages call the file. Throws LocatedError(bad_data) with the first place that
/// cannot be read, or that names another unit than `lengths` (D, the default, gives way to it), and
/// Error(bad_data) where there is no such frame.
BedTable parse_bed_table(const std::string& text, const std::string& name, const LengthRule& lengths,
                         int frame = 0);

}  // namespace talus::session
