#pragma once
/// Cells of a line of a table of grains, and the meaning of its columns. Private to bed_table.h.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/scenario.h"

namespace talus::session {

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
  scenario::LengthUnit unit = scenario::LengthUnit::mean_diameter;
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
std::string unit_text(scenario::LengthUnit unit);

/// Returns the columns that a line names. Throws LocatedError(bad_data) if x, the height or the size is
/// missing or duplicated, or has a unit that is unknown or contradicts `unit` (bed_table.h).
TableColumns named_columns(const TablePlace& place, std::string_view line, scenario::LengthUnit unit);

/// Returns the columns that a comment names, if it has a name for each of `count`, including x, height and
/// size; otherwise nothing.
std::optional<TableColumns> columns_of_comment(const TablePlace& place, std::string_view comment,
                                               scenario::LengthUnit unit, std::size_t count);

}  // namespace talus::session
