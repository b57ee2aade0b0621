#include "session/bed_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <optional>
#include <string_view>
#include <utility>

#include "base/errors.h"
#include "base/visible_text.h"
#include "scenario/text.h"
#include "session/table_columns.h"

namespace talus::session {
namespace {

/// The text after its byte-order mark.
std::string_view unmarked(std::string_view text, const std::string& name) {
  constexpr std::string_view utf8 = "\xef\xbb\xbf", low_first = "\xff\xfe", high_first = "\xfe\xff";
  if (text.starts_with(low_first) || text.starts_with(high_first) ||
      text.find('\0') != std::string_view::npos)
    throw Error(ExitCode::bad_data,
                name + ": this is not a table in UTF-8, but in UTF-16 or no text: save it as UTF-8 text");
  return text.starts_with(utf8) ? text.substr(utf8.size()) : text;
}

/// Takes the first line off a text; it ends with LF, CR LF or CR.
std::string_view take_line(std::string_view& rest) {
  const auto end = rest.find_first_of("\r\n");
  const std::string_view line = rest.substr(0, end);
  const bool is_pair = end != std::string_view::npos && rest.substr(end).starts_with("\r\n");
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + (is_pair ? 2 : 1));
  return line;
}

/// How a number is written; NaN and infinities are written as numbers too.
std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range && end == text.data() + text.size()) return HUGE_VAL;
  const bool whole = error == std::errc() && end == text.data() + text.size() && !text.empty();
  return whole ? std::optional(value) : std::nullopt;
}

bool are_names(std::string_view line) {
  const auto is_number = [](const TableCell& cell) { return number_in(cell.text).has_value(); };
  return !is_number(cells_of(line, false).front()) && std::ranges::none_of(cells_of(line, true), is_number);
}

/// The value of a column, in its unit.
double value_in(const TablePlace& place, const TableColumn& column, const TableCell& cell) {
  const std::optional<double> value = number_in(cell.text);
  if (value && std::isfinite(*value)) return *value;
  const bool decimal_comma = cell.text.find(',') != std::string_view::npos;
  place.refuse(cell.column, fmt::format("{} = \"{}\": expected a finite number{}, in {}", column.name,
                                        visible_word(cell.text), decimal_comma ? " with a decimal point" : "",
                                        unit_text(column.unit)));
}

void require_columns(const TablePlace& place, const TableColumns& columns,
                     const std::vector<TableCell>& cells) {
  if (cells.size() == columns.count) return;
  const std::string expected =
      columns.line == 0
          ? "three, x, y and radius, or a first line that names the columns"
          : fmt::format("{}, one for each column that line {} names", columns.count, columns.line);
  place.refuse(cells.front().column,
               fmt::format("the line has {} values: expected {}", cells.size(), expected));
}

TableGrain grain_of(const TablePlace& place, const TableColumns& columns, const std::vector<TableCell>& cells,
                    double mean_diameter) {
  require_columns(place, columns, cells);
  const auto length_in = [&](const TableColumn& column) {
    return in_metres(value_in(place, column, cells[column.at]), column.unit, mean_diameter);
  };
  const double x = length_in(columns.x), y = length_in(columns.height), size = length_in(columns.size);
  if (size <= 0.0)
    place.refuse(cells[columns.size.at].column,
                 fmt::format("{} = {}: expected a finite number > 0, in {}", columns.size.name,
                             scenario::short_text(value_in(place, columns.size, cells[columns.size.at])),
                             unit_text(columns.size.unit)));
  if (columns.depth && length_in(*columns.depth) != 0.0)
    place.refuse(cells[columns.depth->at].column,
                 fmt::format("z = {}: expected 0, because y is the height; leave the column y out if it is z",
                             visible_word(cells[columns.depth->at].text)));
  return {x, y, columns.is_diameter ? 0.5 * size : size, place.line};
}

/// The columns that the last comment to name them has; x, y and radius if none does.
TableColumns columns_of_comments(const std::vector<std::pair<TablePlace, std::string_view>>& comments,
                                 scenario::LengthUnit unit, std::size_t count) {
  for (auto comment = comments.rbegin(); comment != comments.rend(); ++comment)
    if (auto columns = columns_of_comment(comment->first, comment->second, unit, count)) return *columns;
  return {{0, "x", unit}, {1, "y", unit}, {2, "radius", unit}};
}

}  // namespace

double in_metres(double length, scenario::LengthUnit unit, double mean_diameter) {
  switch (unit) {
    case scenario::LengthUnit::mean_diameter:
      return length * mean_diameter;
    case scenario::LengthUnit::metre:
      return length;
    case scenario::LengthUnit::centimetre:
      return length / 1e2;
    case scenario::LengthUnit::millimetre:
      return length / 1e3;
    case scenario::LengthUnit::micrometre:
      break;
  }
  return length / 1e6;
}

std::vector<TableGrain> parse_bed_table(const std::string& text, const std::string& name,
                                        scenario::LengthUnit unit, double mean_diameter) {
  std::vector<TableGrain> grains;
  TablePlace place{name, 0};
  std::vector<std::pair<TablePlace, std::string_view>> comments;
  std::optional<TableColumns> columns;
  for (std::string_view rest = unmarked(text, name); !rest.empty();) {
    ++place.line;
    const std::string_view line = take_line(rest);
    if (cells_of(line, false).empty()) {
      if (const std::string_view words = comment_of(line); !words.empty() && !columns)
        comments.emplace_back(place, words);
    } else if (!columns && are_names(line)) {
      columns = named_columns(place, line, unit);
    } else {
      if (!columns) columns = columns_of_comments(comments, unit, cells_of(line, false).size());
      grains.push_back(grain_of(place, *columns, cells_of(line, columns->tabs), mean_diameter));
    }
  }
  return grains;
}

}  // namespace talus::session
