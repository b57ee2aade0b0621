#include "view/bookmarks.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/paths.h"
#include "base/text.h"
#include "base/text_stream.h"
#include "base/visible_text.h"
#include "core/trigonometry.h"
#include "io/durable_file.h"

namespace talus::view {
namespace {

constexpr const char* header = "time (s),tilt (deg),note";
constexpr std::string_view folder_ending = ".run";

/// Reads a number and the comma after it, and removes both from the line; returns false if the line does not
/// begin with them.
bool take_number(std::string_view& line, double& value) {
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
  if (error != std::errc() || end == line.data() + line.size() || *end != ',' || !std::isfinite(value))
    return false;
  line.remove_prefix(static_cast<std::size_t>(end - line.data()) + 1);
  return true;
}

/// Reads a quoted field that extends to the end of the line, without the quotes; returns false if there is
/// none.
bool take_quoted(std::string_view line, std::string& text) {
  if (line.size() < 2 || line.front() != '"' || line.back() != '"') return false;
  line = line.substr(1, line.size() - 2);
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '"' && (k + 1 == line.size() || line[++k] != '"')) return false;
    text += line[k];
  }
  return true;
}

Bookmark bookmark_of(std::string_view line, const std::string& path, int number) {
  Bookmark bookmark;
  double tilt = 0.0;
  std::string_view rest = line;
  if (!take_number(rest, bookmark.time) || !take_number(rest, tilt) || !take_quoted(rest, bookmark.note))
    throw LocatedError(
        ExitCode::bad_data,
        fmt::format("{}:{}:1: error: expected a time in s, a tilt in deg and a note in quotes, with commas "
                    "between, found {}",
                    path, number, visible_word(line)));
  bookmark.tilt = radians(tilt);
  return bookmark;
}

}  // namespace

std::string bookmarks_path(const std::string& run) {
  std::string_view name = run;
  while (name.size() > 1 && name.ends_with('/')) name.remove_suffix(1);
  if (name.ends_with(folder_ending)) name.remove_suffix(folder_ending.size());
  return fmt::format("{}.bookmarks.csv", name);
}

std::vector<Bookmark> read_bookmarks(const std::string& path) {
  if (!is_there(path)) return {};
  std::vector<Bookmark> bookmarks;
  std::istringstream lines = text_stream(io::read_text(path));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty() || (number == 1 && line == header)) continue;
    set_bookmark(bookmarks, bookmark_of(line, path, number));
  }
  return bookmarks;
}

void write_bookmarks(const std::string& path, const std::vector<Bookmark>& bookmarks) {
  std::string text = fmt::format("{}\n", header);
  for (const Bookmark& bookmark : bookmarks)
    text += fmt::format("{},{},{}\n", bookmark.time, degrees(bookmark.tilt), csv_quoted(bookmark.note));
  io::write_text(path, text);
}

void set_bookmark(std::vector<Bookmark>& bookmarks, Bookmark bookmark) {
  std::ranges::replace_if(
      bookmark.note, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  const auto place = std::ranges::lower_bound(bookmarks, bookmark.time, {}, &Bookmark::time);
  if (place != bookmarks.end() && place->time == bookmark.time)
    *place = std::move(bookmark);
  else
    bookmarks.insert(place, std::move(bookmark));
}

}  // namespace talus::view
