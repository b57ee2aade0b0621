#include "base/text_table.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/text.h"

namespace talus {
namespace {

/// Returns the number of characters of a UTF-8 text.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::vector<std::size_t> widths_of(const TextTable& table) {
  std::vector<std::size_t> widths;
  for (const TextColumn& column : table.columns)
    widths.push_back(std::max(width_of(column.title), width_of(column.unit)));
  for (const auto& row : table.rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width_of(row[k].text));
  return widths;
}

std::string padded(const std::string& text, std::size_t width, bool to_the_right) {
  const std::size_t blanks = width - std::min(width, width_of(text));
  return fmt::format("{:{}}{}{:{}}", "", to_the_right ? blanks : 0, text, "", to_the_right ? 0 : blanks);
}

std::string trimmed(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line.append("\n");
}

/// Returns a line of aligned text; `text_of(k)` is the text of column k.
template <typename TextOf>
std::string line_of(const TextTable& table, const std::vector<std::size_t>& widths, std::size_t indent,
                    const TextOf& text_of) {
  std::string line(indent, ' ');
  for (std::size_t k = 0; k < widths.size(); ++k)
    line += fmt::format("{}{}",
                        k == 0                           ? ""
                        : table.columns[k].group.empty() ? "  "
                                                         : " | ",
                        padded(text_of(k), widths[k], table.columns[k].numbers));
  return trimmed(line);
}

/// Returns the line of groups, each at the left edge of its first column.
std::string group_line(const TextTable& table, const std::vector<std::size_t>& widths, std::size_t indent) {
  std::string line;
  std::size_t place = indent;
  for (std::size_t k = 0; k < widths.size(); ++k) {
    const std::string& group = table.columns[k].group;
    if (!group.empty()) line = fmt::format("{} | {}", padded(line, place, false), group);
    place += (k == 0 ? 0 : group.empty() ? 2 : 3) + widths[k];
  }
  return trimmed(line);
}

}  // namespace

std::string number_cell(std::string_view format, double value) {
  if (std::isnan(value)) return "-";
  const std::string text = fmt::format(fmt::runtime(format), value);
  const std::string zero = fmt::format(fmt::runtime(format), 0.0);
  return text.starts_with('-') && text.substr(1) == zero.substr(zero.starts_with('+') ? 1 : 0) ? zero : text;
}

std::string aligned_text(const TextTable& table, std::size_t indent) {
  const std::vector<std::size_t> widths = widths_of(table);
  const std::vector<TextColumn>& columns = table.columns;
  const auto line = [&](const auto& text_of) { return line_of(table, widths, indent, text_of); };
  std::string text;
  if (!std::ranges::all_of(columns, &std::string::empty, &TextColumn::group))
    text += group_line(table, widths, indent);
  text += line([&](std::size_t k) { return columns[k].title; });
  if (!std::ranges::all_of(columns, &std::string::empty, &TextColumn::unit))
    text += line([&](std::size_t k) { return columns[k].unit; });
  for (const auto& row : table.rows)
    text += line([&](std::size_t k) { return k < row.size() ? row[k].text : std::string(); });
  return text;
}

std::string csv_text(const TextTable& table, bool titles) {
  std::string text = titles ? fmt::format("{}\n", joined(table.columns, ",", &TextColumn::title)) : "";
  for (const auto& row : table.rows) text += joined(row, ",", &TextCell::text) + "\n";
  return text;
}

}  // namespace talus
