#pragma once
/// A table of words and numbers as aligned text or CSV.

#include <string>
#include <string_view>
#include <vector>

namespace talus {

struct TextCell {
  std::string text;
};

struct TextColumn {
  std::string title;
  bool numbers = false;    ///< whether to align to the right
  std::string unit = {};   ///< unit below the title, in aligned text
  std::string group = {};  ///< heading above this and the following columns without one, in aligned text
};

/// A table. Rows may have fewer cells than the table has columns, and the last column may have no title.
struct TextTable {
  std::vector<TextColumn> columns;
  std::vector<std::vector<TextCell>> rows;
};

/// Formats a number with a format of libfmt, such as "{:.3f}"; "-" for NaN, no minus for 0.
std::string number_cell(std::string_view format, double value);

/// Returns aligned text: columns as wide as their widest cell, two blanks apart, after `indent` blanks, with
/// a bar before each group.
std::string aligned_text(const TextTable& table, std::size_t indent = 0);

/// Returns CSV: a line of titles, if requested, and one line for each row. Texts that may contain commas must
/// be quoted (csv_quoted).
std::string csv_text(const TextTable& table, bool titles = true);

}  // namespace talus
