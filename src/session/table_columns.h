#pragma once
/// The cells of a line of a table of grains, and which column of it is what. Private to bed_table.h.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenario/scenario.h"

namespace talus::session {

/// A value or a name, without its quotes.
struct TableCell {
  std::string_view text;
  std::size_t column = 0;  ///< of its first character in the line, from 1
};

struct TablePlace {
  const std::string& table;
  std::size_t line = 0;  ///< from 1

  [[noreturn]] void refuse(std::size_t column, const std::string& message) const;
};

/// The cells of a line without its comment, separated by semicolons, commas, `tabs` or else by any white
/// space; none if all are empty.
std::vector<TableCell> cells_of(std::string_view line, bool tabs);

/// What follows a # that is not in quotes.
std::string_view comment_of(std::string_view line);

/// Takes the first line off a text; it ends with LF, CR LF or CR.
std::string_view take_line(std::string_view& rest);

/// How a number is written; NaN and infinities are written as numbers too.
std::optional<double> number_in(std::string_view text);

struct TableColumn {
  std::size_t at = 0;  ///< among the cells of a line
  std::string name;
  scenario::LengthUnit unit = scenario::LengthUnit::mean_diameter;
  bool scaled = false;   ///< its values go from 0 to 1 through the box
  bool of_dump = false;  ///< by such a name as xu, which gives way to x
};

struct TableColumns {
  TableColumn x, height, size;
  std::optional<TableColumn> depth{};  ///< a z beside y
  std::optional<TableColumn> id{}, frame{};
  std::vector<std::string> ignored{};  ///< names of the others
  bool is_diameter = false;            ///< the size
  std::size_t count = 3;               ///< of all columns
  std::size_t line = 0;                ///< that names them; 0: none does
  bool tabs = false;                   ///< separate the names, which may hold blanks
};

/// "mean diameters D", or the name of another unit.
std::string unit_text(scenario::LengthUnit unit);

/// The columns that a line names. Throws LocatedError(bad_data) where x, the height or the size is missing or
/// there twice, or has a unit that is unknown or contradicts `unit` (bed_table.h).
TableColumns named_columns(const TablePlace& place, std::string_view line, scenario::LengthUnit unit);

/// The columns that a comment names if it has a name for each of `count`, with x, height and size among them;
/// else nothing.
std::optional<TableColumns> columns_of_comment(const TablePlace& place, std::string_view comment,
                                               scenario::LengthUnit unit, std::size_t count);

}  // namespace talus::session
