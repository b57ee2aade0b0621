#pragma once
/// A table of words and numbers as text: aligned, CSV, Markdown. Reports print it as HTML
/// (studies/report_document.h).

#include <string>
#include <string_view>
#include <vector>

namespace talus {

/// How a cell is marked in HTML.
enum class Tone { plain, good, bad, muted };

struct TextCell {
  std::string text;
  std::string note = {};  ///< a second line, smaller; HTML alone has it
  Tone tone = Tone::plain;
};

struct TextColumn {
  std::string title;
  bool numbers = false;    ///< aligned to the right
  std::string unit = {};   ///< below the title of aligned text
  std::string group = {};  ///< above this column and those that follow without one, in aligned text
};

/// Rows may have fewer cells than there are columns, and the last column may be without a title.
struct TextTable {
  std::vector<TextColumn> columns;
  std::vector<std::vector<TextCell>> rows;
};

/// A number by a format of libfmt, such as "{:.3f}"; "-" for NaN.
std::string number_cell(std::string_view format, double value);

/// Columns as wide as their widest cell, two blanks apart, after `indent` blanks; a bar before each group.
std::string aligned_text(const TextTable& table, std::size_t indent = 0);

/// One line for the titles, unless they were printed before, and one for each row. Texts that may hold commas
/// must be quoted (csv_quoted).
std::string csv_text(const TextTable& table, bool titles = true);

/// Columns one below the other. Texts of a user must be escaped (markdown_escaped).
std::string markdown_text(const TextTable& table);

/// A text in a line of Markdown in which it is no HTML, no link and no column of its own.
std::string markdown_escaped(std::string_view text);

}  // namespace talus
