#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "base/errors.h"
#include "base/text.h"
#include "scenario/text.h"
#include "session/bed_table.h"

namespace talus::session {
namespace {

TableCell trimmed(const TableCell& cell) {
  const std::size_t blanks = std::min(cell.text.find_first_not_of(" \t"), cell.text.size());
  return {scenario::trimmed(cell.text), cell.column + blanks};
}

TableCell unquoted(TableCell cell) {
  cell = trimmed(cell);
  const std::string_view text = cell.text;
  if (text.size() < 2 || text.front() != text.back() || (text.front() != '"' && text.front() != '\''))
    return cell;
  return trimmed({text.substr(1, text.size() - 2), cell.column + 1});
}

/// Returns the position of the first `wanted` character outside double quotes.
std::size_t find_outside_quotes(std::string_view text, std::string_view wanted) {
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == '"') quoted = !quoted;
    if (!quoted && wanted.find(text[k]) != std::string_view::npos) return k;
  }
  return std::string_view::npos;
}

/// Returns the line without its comment.
TableCell values_of(std::string_view line) { return {line.substr(0, find_outside_quotes(line, "#")), 1}; }

std::string_view separator_of(std::string_view line, bool tabs) {
  const std::string_view text = trimmed(values_of(line)).text;
  for (const std::string_view separator : {";", ",", tabs ? "\t" : ","})
    if (find_outside_quotes(text, separator) != std::string_view::npos) return separator;
  return " \t";
}

/// Joins units with their names, because blanks separate "x [mm]" into two cells.
void join_units(std::string_view line, std::vector<TableCell>& cells) {
  std::vector<TableCell> joined;
  for (const TableCell& cell : cells) {
    const bool is_unit = cell.text.starts_with('[') || cell.text.starts_with('(');
    if (is_unit && !joined.empty()) {
      TableCell& name = joined.back();
      name.text = line.substr(name.column - 1, cell.column - name.column + cell.text.size());
    } else {
      joined.push_back(cell);
    }
  }
  cells = std::move(joined);
}

std::string lower(std::string_view text) {
  std::string low(text);
  std::ranges::transform(low, low.begin(), [](unsigned char c) { return std::tolower(c); });
  return low;
}

constexpr std::array units = {
    std::pair<std::string_view, LengthUnit>{"d", LengthUnit::mean_diameter},
    std::pair<std::string_view, LengthUnit>{"m", LengthUnit::metre},
    std::pair<std::string_view, LengthUnit>{"cm", LengthUnit::centimetre},
    std::pair<std::string_view, LengthUnit>{"mm", LengthUnit::millimetre},
    std::pair<std::string_view, LengthUnit>{"um", LengthUnit::micrometre},
    std::pair<std::string_view, LengthUnit>{"\xc2\xb5m", LengthUnit::micrometre},  // micro sign
    std::pair<std::string_view, LengthUnit>{"\xce\xbcm", LengthUnit::micrometre},  // Greek letter
};

std::optional<LengthUnit> unit_of(std::string_view word) {
  const auto found = std::ranges::find(units, word, &std::pair<std::string_view, LengthUnit>::first);
  return found == units.end() ? std::nullopt : std::optional(found->second);
}

enum class Role { x, y, z, radius, diameter, id, frame };
constexpr std::size_t role_count = 7;

struct RoleName {
  std::string_view name;
  Role role;
  bool of_dump = false;  ///< any other name of its role takes precedence
  bool scaled = false;   ///< values from 0 to 1 across the box
};
constexpr std::array roles = {
    RoleName{"x", Role::x},
    RoleName{"y", Role::y},
    RoleName{"z", Role::z},
    RoleName{"r", Role::radius},
    RoleName{"radius", Role::radius},
    RoleName{"radii", Role::radius},
    RoleName{"d", Role::diameter},
    RoleName{"diameter", Role::diameter},
    RoleName{"id", Role::id},
    RoleName{"frame", Role::frame},
    RoleName{"xu", Role::x, true},
    RoleName{"yu", Role::y, true},
    RoleName{"zu", Role::z, true},
    RoleName{"xs", Role::x, true, true},
    RoleName{"ys", Role::y, true, true},
    RoleName{"zs", Role::z, true, true},
    RoleName{"xsu", Role::x, true, true},
    RoleName{"ysu", Role::y, true, true},
    RoleName{"zsu", Role::z, true, true},
};

/// A column name with its meaning.
struct NamedColumn {
  Role role = Role::x;
  TableColumn column;
};

/// Returns the meaning of a column name; empty for a name without a role here, such as "x_velocity".
std::optional<NamedColumn> meaning_of(const TablePlace& place, const TableCell& cell, std::size_t at,
                                      LengthUnit unit) {
  const std::string name = lower(cell.text);
  const auto end = std::min(name.find_first_of(" \t_/[("), name.size());
  const auto role = std::ranges::find(roles, std::string_view(name).substr(0, end), &RoleName::name);
  if (role == roles.end()) return std::nullopt;
  NamedColumn named{role->role, {at, name.substr(0, end), unit, role->scaled, role->of_dump}};
  if (end == name.size()) return named;
  std::string_view word = trimmed({std::string_view(name).substr(end), 1}).text;
  const bool bracketed = word.size() >= 2 && ((word.front() == '[' && word.back() == ']') ||
                                              (word.front() == '(' && word.back() == ')'));
  if (bracketed)
    word = trimmed({word.substr(1, word.size() - 2), 1}).text;
  else if (word.starts_with('_') || word.starts_with('/'))
    word.remove_prefix(1);
  const std::optional<LengthUnit> own = unit_of(word);
  if (!own && !bracketed) return std::nullopt;
  const std::string shown = visible_word(cell.text);
  if (!own)
    place.refuse(cell.column,
                 fmt::format("the column \"{}\" has an unknown unit: expected D, m, cm, mm or um", shown));
  if (unit != LengthUnit::mean_diameter && *own != unit)
    place.refuse(
        cell.column,
        fmt::format("the column \"{}\" has a unit other than deposition.file_unit: omit one of them", shown));
  named.column.unit = *own;
  return named;
}

/// Finds the columns among the cells; returns a message about missing ones, or an empty text.
std::string find_columns(const TablePlace& place, const std::vector<TableCell>& cells, LengthUnit unit,
                         TableColumns& columns) {
  std::array<std::optional<TableColumn>, role_count> found;
  std::string twice;
  for (std::size_t at = 0; at < cells.size(); ++at) {
    const std::optional<NamedColumn> named = meaning_of(place, cells[at], at, unit);
    if (!named && !cells[at].text.empty()) columns.ignored.push_back(visible_word(cells[at].text));
    if (!named) continue;
    std::optional<TableColumn>& column = found[static_cast<std::size_t>(named->role)];
    const bool is_length = named->role != Role::id && named->role != Role::frame;
    if (column && named->column.of_dump) continue;
    if (column && !column->of_dump && is_length && twice.empty()) twice = named->column.name;
    column = named->column;
  }
  const auto column = [&](Role role) { return found[static_cast<std::size_t>(role)]; };
  if (column(Role::radius) && column(Role::diameter)) twice = "the size";
  if (!twice.empty()) return fmt::format("more than one column for {}", twice);
  columns.is_diameter = column(Role::diameter).has_value();
  const auto height = column(Role::y) ? column(Role::y) : column(Role::z);
  const auto size = columns.is_diameter ? column(Role::diameter) : column(Role::radius);
  if (!column(Role::x) || !height || !size)
    return fmt::format("no column for {}", !column(Role::x) ? "x" : !height ? "the height" : "the size");
  columns.x = *column(Role::x);
  columns.height = *height;
  columns.size = *size;
  if (column(Role::y)) columns.depth = column(Role::z);
  columns.id = column(Role::id);
  columns.frame = column(Role::frame);
  return "";
}

TableColumns columns_in(const TablePlace& place, std::string_view line, std::vector<TableCell>& cells) {
  cells = cells_of(line, true);
  const std::string_view separator = separator_of(line, true);
  if (separator == " \t") join_units(line, cells);
  TableColumns columns;
  columns.count = cells.size();
  columns.line = place.line;
  columns.tabs = separator == "\t";
  return columns;
}

}  // namespace

std::string TablePlace::message(std::size_t column, const std::string& text) const {
  return fmt::format("{}:{}:{}: error: {}", table, line, column, text);
}

void TablePlace::refuse(std::size_t column, const std::string& text) const {
  throw LocatedError(ExitCode::bad_data, message(column, text));
}

std::string_view take_line(std::string_view& rest) {
  const auto end = rest.find_first_of("\r\n");
  const std::string_view line = rest.substr(0, end);
  const bool is_pair = end != std::string_view::npos && rest.substr(end).starts_with("\r\n");
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + (is_pair ? 2 : 1));
  return line;
}

std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range && end == text.data() + text.size()) return HUGE_VAL;
  const bool whole = error == std::errc() && end == text.data() + text.size() && !text.empty();
  return whole ? std::optional(value) : std::nullopt;
}

std::string_view comment_of(std::string_view line) {
  const auto begin = find_outside_quotes(line, "#");
  return begin == std::string_view::npos ? std::string_view() : line.substr(begin + 1);
}

std::vector<TableCell> cells_of(std::string_view line, bool tabs) {
  const std::string_view separator = separator_of(line, tabs);
  const bool white = separator == " \t";
  // Between tabs, an empty cell at an end counts as a cell.
  TableCell rest = separator == "\t" ? values_of(line) : trimmed(values_of(line));
  std::vector<TableCell> cells;
  while (!rest.text.empty()) {
    const auto end = find_outside_quotes(rest.text, separator);
    cells.push_back(unquoted({rest.text.substr(0, end), rest.column}));
    if (end == std::string_view::npos) break;
    rest = {rest.text.substr(end + 1), rest.column + end + 1};
    if (white) rest = trimmed(rest);
    if (rest.text.empty()) cells.push_back(rest);
  }
  const bool any = std::ranges::any_of(cells, [](const TableCell& cell) { return !cell.text.empty(); });
  return any ? cells : std::vector<TableCell>();
}

std::string unit_text(LengthUnit unit) {
  if (unit == LengthUnit::mean_diameter) return "mean diameters D";
  return std::string(std::ranges::find(units, unit, &std::pair<std::string_view, LengthUnit>::second)->first);
}

TableColumns named_columns(const TablePlace& place, std::string_view line, LengthUnit unit) {
  std::vector<TableCell> cells;
  TableColumns columns = columns_in(place, line, cells);
  const std::string fault = find_columns(place, cells, unit, columns);
  if (!fault.empty()) {
    const std::string names =
        joined(cells, ", ", [](const TableCell& cell) { return "\"" + visible_word(cell.text) + "\""; });
    place.refuse(cells.empty() ? 1 : cells.front().column,
                 fmt::format("the columns are named {}, {}: expected x, y (or z) for the height, and r, "
                             "radius, d or diameter, in any order; each may have a unit, as in x [mm]",
                             names, fault));
  }
  return columns;
}

std::optional<TableColumns> columns_of_comment(const TablePlace& place, std::string_view comment,
                                               LengthUnit unit, std::size_t count) {
  std::vector<TableCell> cells;
  TableColumns columns = columns_in(place, comment, cells);
  if (cells.size() == count && find_columns(place, cells, unit, columns).empty()) return columns;
  return std::nullopt;
}

}  // namespace talus::session
