#pragma once
/// Text tables of beds: one grain per line.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/scenario.h"

namespace talus::session {

using scenario::LengthUnit;

/// A grain of a table. Lengths in m.
struct TableGrain {
  double x = 0.0, y = 0.0;  ///< centre; y from the top of the floor
  double radius = 0.0;      ///< > 0
  std::size_t line = 0;     ///< line of the file, from 1
  double z = 0.0;           ///< position of the plane of the bed
  double id = 0.0;          ///< id in a dump; otherwise 0
  double frame = 0.0;       ///< value of the column `frame`
};

/// Extent of the box of a dump along x.
struct TableBox {
  double low = 0.0, high = 0.0;     ///< m
  std::optional<bool> is_periodic;  ///< along x; not known if the file does not say so
};

struct BedTable {
  std::vector<TableGrain> grains;  ///< sorted by id in a dump, otherwise in file order
  std::optional<TableBox> box;     ///< box of a dump
  /// Choices made while reading: "frame 0 of 3; x and z are the plane; ignored: type, vx".
  std::string remark;
};

/// Conversion of the lengths of a file.
struct LengthRule {
  LengthUnit unit = LengthUnit::mean_diameter;
  double mean_diameter = 1.0;  ///< m
  double scale = 1.0;          ///< factor on all lengths
};

/// Converts a length to m.
double in_metres(double length, LengthUnit unit, double mean_diameter);

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

// For the sources of this header only: cells of a line of a table of grains, and the meaning of its columns.

/// A value or a name, without quotes.
struct TableCell {
  std::string_view text;
  std::size_t column = 0;  ///< position of its first character in the line, from 1
};

struct TablePlace {
  const std::string& table;
  std::size_t line = 0;  ///< line number, from 1

  /// Returns a message with this place.
  std::string message(std::size_t column, const std::string& text) const;
  /// Throws it.
  [[noreturn]] void refuse(std::size_t column, const std::string& text) const;
};

/// Returns the cells of a line without its comment, separated by semicolons, commas, `tabs` or otherwise any
/// white space; none if all are empty.
std::vector<TableCell> cells_of(std::string_view line, bool tabs);

/// Returns the text after a # that is not in quotes.
std::string_view comment_of(std::string_view line);

/// Removes the first line from a text and returns it; it ends with LF, CR LF or CR.
std::string_view take_line(std::string_view& rest);

/// Returns the number that a text denotes, including NaN and infinities; no value for other text.
std::optional<double> number_in(std::string_view text);

struct TableColumn {
  std::size_t at = 0;  ///< index of its cell in a line
  std::string name;
  LengthUnit unit = LengthUnit::mean_diameter;
  bool scaled = false;   ///< values from 0 to 1 across the box
  bool of_dump = false;  ///< named as in a dump, e.g. xu; a column x takes precedence
};

struct TableColumns {
  TableColumn x, height, size;
  std::optional<TableColumn> depth{};  ///< z, if there is a y
  std::optional<TableColumn> id{}, frame{};
  std::vector<std::string> ignored{};  ///< names of other columns
  bool is_diameter = false;            ///< whether the size is a diameter
  std::size_t count = 3;               ///< number of columns
  std::size_t line = 0;                ///< line that names them; 0: none
  bool tabs = false;                   ///< whether tabs separate the names, which may contain blanks
};

/// Returns "mean diameters D", or the name of another unit.
std::string unit_text(LengthUnit unit);

/// Returns the columns that a line names. Throws LocatedError(bad_data) if x, the height or the size is
/// missing or duplicated, or has a unit that is unknown or contradicts `unit` (bed_table.h).
TableColumns named_columns(const TablePlace& place, std::string_view line, LengthUnit unit);

/// Returns the columns that a comment names, if it has a name for each of `count`, including x, height and
/// size; otherwise nothing.
std::optional<TableColumns> columns_of_comment(const TablePlace& place, std::string_view comment,
                                               LengthUnit unit, std::size_t count);

// Also for them only: frames of a dump of LAMMPS or LIGGGHTS, or of extended XYZ.

/// A frame, which is a table with named columns. Lengths as in the file.
struct DumpFrame {
  std::string label;           ///< "timestep 1000"; empty: none
  std::string names;           ///< names of its columns, separated by blanks; empty if it has none
  std::size_t names_line = 0;  ///< line of the names, from 1
  std::string_view rows;       ///< text from the row of its first grain to the end
  std::size_t count = 0;       ///< stated number of its grains
  std::size_t found = 0;       ///< number of rows found
  bool has_box = false;
  std::optional<bool> is_periodic;      ///< see TableBox
  std::string units;                    ///< word after ITEM: UNITS, e.g. "si"; empty: none
  std::array<double, 3> low{}, high{};  ///< bounds of the box
  /// Message about its first fault, with its place, which concerns only those who read this frame; empty if
  /// it has none. A box that is not at right angles to the axes is one.
  std::string fault;
  std::size_t fault_line = 0;
};

/// Removes the first line from a text and returns it, after lines of comments; `line` counts all.
std::string_view take_row(std::string_view& rest, std::size_t& line);

/// Returns the frames in order; none for a text in another format. Throws LocatedError(bad_data) for a line
/// before the first frame that does not belong to such a file.
std::vector<DumpFrame> dump_frames(std::string_view text, const std::string& name);

}  // namespace talus::session
