#pragma once
/// Text tables of beds: one grain per line.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scenario/scenario.h"

namespace talus::session {

/// A grain of a table. Lengths in m.
struct TableGrain {
  double x = 0.0, y = 0.0;  ///< centre; y from the top of the floor
  double radius = 0.0;      ///< > 0
  std::size_t line = 0;     ///< line of the file, from 1
  double z = 0.0;           ///< position of the plane of the bed
  double id = 0.0;          ///< id in a dump; otherwise 0
  double frame = 0.0;       ///< value of the column `frame`
};

/// Whether a box is periodic along x; not known if the file does not say so.
enum class BoxEnds { unknown, periodic, fixed };

/// Extent of the box of a dump along x.
struct TableBox {
  double low = 0.0, high = 0.0;  ///< m
  BoxEnds ends = BoxEnds::unknown;
};

struct BedTable {
  std::vector<TableGrain> grains;  ///< sorted by id in a dump, otherwise in file order
  std::optional<TableBox> box;     ///< box of a dump
  /// Choices made while reading: "frame 0 of 3; x and z are the plane; ignored: type, vx".
  std::string remark;
};

/// Conversion of the lengths of a file.
struct LengthRule {
  scenario::LengthUnit unit = scenario::LengthUnit::mean_diameter;
  double mean_diameter = 1.0;  ///< m
  double scale = 1.0;          ///< factor on all lengths
};

/// Converts a length to m.
double in_metres(double length, scenario::LengthUnit unit, double mean_diameter);

/// Parses the grains of a UTF-8 text: of a frame (from 0; -1: the last) of a dump of LAMMPS or LIGGGHTS or of
/// extended XYZ, or of a table. A table has one grain per line: x, y and radius, or the columns named by the
/// first line (or by the last comment before the grains, if it names them all, including "#format x_y_z_r" of
/// YADE), in any order: x, y or z, and radius or diameter. A name may state the unit of its column, "x [mm]";
/// a column `frame` divides the table into frames, in the order of its values, and columns of other names are
/// skipped. What is damaged in another frame than the requested one has no effect. Values are
/// separated by semicolons, commas or white space, and may be quoted; a # starts a comment. Columns without a
/// unit use that of `lengths`. With x, y and z, y is the height if z is the same for all grains, and z if y
/// is. `name` denotes the file in messages. Throws LocatedError(bad_data) with the first position that cannot
/// be read, or that names another unit than `lengths` (the default D accepts any unit), and Error(bad_data)
/// if the frame does not exist.
BedTable parse_bed_table(const std::string& text, const std::string& name, const LengthRule& lengths,
                         int frame = 0);

}  // namespace talus::session
