#include "session/bed_table.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <optional>
#include <string_view>

#include "core/errors.h"
#include "core/visible_text.h"
#include "scenario/text.h"

namespace talus {
namespace {

constexpr std::array<std::string_view, 3> column_names = {"x", "y", "radius"};

struct TableCell {
  std::string_view text;
  std::size_t column = 0;  ///< of its first character, from 1
};

struct TableLine {
  const std::string& table;
  std::size_t number = 0;  ///< from 1

  [[noreturn]] void refuse(std::size_t column, const std::string& message) const {
    throw LocatedError(ExitCode::bad_data,
                       fmt::format("{}:{}:{}: error: {}", table, number, column, message));
  }
};

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r'; }

TableCell trimmed(TableCell field) {
  while (!field.text.empty() && is_space(field.text.front())) {
    field.text.remove_prefix(1);
    ++field.column;
  }
  while (!field.text.empty() && is_space(field.text.back())) field.text.remove_suffix(1);
  return field;
}

/// The fields of a line without its comment; none of an empty one.
std::vector<TableCell> fields_of(std::string_view line) {
  TableCell rest = trimmed({line.substr(0, line.find('#')), 1});
  const bool has_commas = rest.text.find(',') != std::string_view::npos;
  std::vector<TableCell> fields;
  while (!rest.text.empty()) {
    const auto end = has_commas ? rest.text.find(',') : rest.text.find_first_of(" \t");
    fields.push_back(trimmed({rest.text.substr(0, end), rest.column}));
    if (end == std::string_view::npos) break;
    rest = {rest.text.substr(end + 1), rest.column + end + 1};
    if (!has_commas) rest = trimmed(rest);
    if (has_commas && rest.text.empty()) fields.push_back(rest);
  }
  return fields;
}

std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

bool are_column_names(const std::vector<TableCell>& fields) {
  const auto is_same = [](const TableCell& field, std::string_view name) {
    return std::ranges::equal(field.text, name, {}, [](unsigned char c) { return std::tolower(c); });
  };
  return std::ranges::equal(fields, column_names, is_same);
}

TableGrain grain_of(const TableLine& line, const std::vector<TableCell>& fields) {
  if (fields.size() != column_names.size())
    line.refuse(fields.front().column,
                fmt::format("the line has {} values: expected three, x, y and radius", fields.size()));
  std::array<double, 3> values{};
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::optional<double> value = number_in(fields[k].text);
    if (!value)
      line.refuse(fields[k].column, fmt::format("{} = \"{}\": expected a finite number, in mean diameters D",
                                                column_names[k], visible_word(fields[k].text)));
    values[k] = *value;
  }
  if (values[2] <= 0.0)
    line.refuse(
        fields[2].column,
        fmt::format("radius = {}: expected a finite number > 0, in mean diameters D", short_text(values[2])));
  return {values[0], values[1], values[2], line.number};
}

}  // namespace

std::vector<TableGrain> parse_bed_table(const std::string& text, const std::string& name) {
  std::vector<TableGrain> grains;
  bool has_begun = false;
  TableLine line{name};
  for (std::string_view rest = text; !rest.empty();) {
    ++line.number;
    const auto end = rest.find('\n');
    const std::vector<TableCell> fields = fields_of(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    if (fields.empty()) continue;
    if (has_begun || !are_column_names(fields)) grains.push_back(grain_of(line, fields));
    has_begun = true;
  }
  return grains;
}

}  // namespace talus
