#include "render/whole_file.h"

#include <charconv>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "core/errors.h"
#include "render/png.h"

namespace talus {
namespace {

/// Reads a file from the beginning; what lies past its end reads as nothing.
class Source {
 public:
  explicit Source(const std::string& path) : file_(path, std::ios::binary | std::ios::ate) {
    size_ = file_ ? static_cast<std::uint64_t>(file_.tellg()) : 0;
    file_.seekg(0);
  }
  std::uint64_t size() const { return size_; }
  std::uint64_t at() const { return at_; }
  bool at_end() const { return at_ == size_; }

  std::optional<std::uint8_t> byte() {
    const int next = file_.get();
    if (next == std::char_traits<char>::eof()) return std::nullopt;
    ++at_;
    return static_cast<std::uint8_t>(next);
  }
  /// The next bytes as a number, the highest first.
  std::optional<std::uint64_t> number(int bytes) {
    std::uint64_t value = 0;
    for (; bytes > 0; --bytes) {
      const auto next = byte();
      if (!next) return std::nullopt;
      value = value << 8 | *next;
    }
    return value;
  }
  std::string text(std::size_t bytes) {
    std::string read(bytes, '\0');
    file_.read(read.data(), static_cast<std::streamsize>(bytes));
    read.resize(static_cast<std::size_t>(file_.gcount()));
    at_ += read.size();
    return read;
  }
  /// False where there are fewer bytes.
  bool skip(std::uint64_t bytes) {
    if (bytes > size_ - at_) return false;
    at_ += bytes;
    file_.seekg(static_cast<std::streamoff>(at_));
    return true;
  }

 private:
  std::ifstream file_;
  std::uint64_t size_ = 0;
  std::uint64_t at_ = 0;
};

bool is_whole_mp4(const std::string& path) {
  Source source(path);
  std::set<std::string> found;
  while (!source.at_end()) {
    const std::uint64_t begin = source.at();
    std::optional<std::uint64_t> size = source.number(4);
    found.insert(source.text(4));
    if (size == 1U) size = source.number(8);
    const std::uint64_t head = source.at() - begin;
    if (!size || *size < head || !source.skip(*size - head)) return false;
  }
  return found.contains("ftyp") && found.contains("moov") && found.contains("mdat");
}

/// A number of EBML: as many bytes more as its first has zeros in front. Nothing where it is cut off, or says
/// that the size is not known.
std::optional<std::uint64_t> ebml_number(Source& source, bool with_marker) {
  const auto first = source.byte();
  if (!first || *first == 0) return std::nullopt;
  int more = 0;
  while ((*first & 0x80 >> more) == 0) ++more;
  const auto rest = source.number(more);
  if (!rest) return std::nullopt;
  const std::uint64_t bits = std::uint64_t{7} * static_cast<std::uint64_t>(more + 1);
  const std::uint64_t all = std::uint64_t{*first} << 8 * more | *rest;
  const std::uint64_t value = all & ((std::uint64_t{1} << bits) - 1);
  if (with_marker) return all;
  return value == (std::uint64_t{1} << bits) - 1 ? std::nullopt : std::optional(value);
}

bool is_whole_webm(const std::string& path) {
  constexpr std::uint64_t head = 0x1A45DFA3, segment = 0x18538067, cluster = 0x1F43B675, cues = 0x1C53BB6B;
  Source source(path);
  std::set<std::uint64_t> found;
  while (!source.at_end()) {
    const auto id = ebml_number(source, true);
    const auto size = id ? ebml_number(source, false) : std::nullopt;
    if (!size) return false;
    found.insert(*id);
    if (*id == segment ? source.at() + *size != source.size() : !source.skip(*size)) return false;
  }
  return found.contains(head) && found.contains(cluster) && found.contains(cues);
}

/// The colours that a byte of flags announces.
bool skip_colours(Source& source, std::uint8_t flags) {
  return (flags & 0x80) == 0 || source.skip(std::uint64_t{3} << ((flags & 7) + 1));
}

bool skip_blocks(Source& source) {
  for (auto size = source.byte(); size; size = source.byte()) {
    if (*size == 0) return true;
    if (!source.skip(*size)) return false;
  }
  return false;
}

bool is_whole_gif(const std::string& path) {
  constexpr std::uint8_t extension = 0x21, image = 0x2C, trailer = 0x3B;
  Source source(path);
  if (!source.text(6).starts_with("GIF8") || !source.skip(4)) return false;
  const auto flags = source.byte();
  if (!flags || !source.skip(2) || !skip_colours(source, *flags)) return false;
  bool has_image = false;
  while (const auto kind = source.byte()) {
    if (*kind == trailer) return has_image && source.at_end();
    if (*kind == extension && source.skip(1) && skip_blocks(source)) continue;
    if (*kind != image || !source.skip(8)) return false;
    const auto of_image = source.byte();
    if (!of_image || !skip_colours(source, *of_image) || !source.skip(1) || !skip_blocks(source))
      return false;
    has_image = true;
  }
  return false;
}

std::string all_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The decimal number at a place of a text.
std::optional<std::size_t> number_at(std::string_view text, std::size_t at) {
  std::size_t value = 0;
  if (at >= text.size()) return std::nullopt;
  const auto read = std::from_chars(text.data() + at, text.data() + text.size(), value);
  return read.ec == std::errc() ? std::optional(value) : std::nullopt;
}

/// Whether object `k` begins at a place of a PDF.
bool is_object(std::string_view text, std::size_t at, std::size_t k) {
  return at < text.size() && text.substr(at).starts_with(std::to_string(k) + " 0 obj");
}

bool is_whole_pdf(const std::string& path) {
  constexpr std::string_view end = "%%EOF\n", start_word = "startxref\n", table_word = "xref\n0 ";
  constexpr std::size_t row = 20;  // bytes: "0000001584 00000 n \n"
  const std::string text = all_of(path);
  const std::size_t start = text.rfind(start_word);
  if (!text.starts_with("%PDF-") || !text.ends_with(end) || start == std::string::npos) return false;
  const auto table = number_at(text, start + start_word.size());
  if (!table || *table >= start) return false;
  if (!std::string_view(text).substr(*table).starts_with(table_word)) {  // a table that is itself an object
    const auto k = number_at(text, *table);
    return k && is_object(text, *table, *k);
  }
  const auto count = number_at(text, *table + table_word.size());
  const std::size_t rows = text.find('\n', *table + table_word.size()) + 1;
  if (!count || rows == 0 || *count > (start - rows) / row) return false;
  for (std::size_t k = 0; k < *count; ++k) {
    const std::string_view line = std::string_view(text).substr(rows + k * row, row);
    const auto at = number_at(line, 0);
    if (!at || (line[17] == 'n' && !is_object(text, *at, k))) return false;
  }
  return true;
}

/// Where a tag that begins at `at` ends: past its '>', those in quotes not counted.
std::size_t end_of_tag(std::string_view text, std::size_t at) {
  if (text.substr(at).starts_with("<!--")) {
    const std::size_t end = text.find("-->", at);
    return end == std::string_view::npos ? end : end + 3;
  }
  char quote = '\0';
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (quote == '\0' && c == '>') return at + 1;
    if (quote == '\0' && (c == '"' || c == '\''))
      quote = c;
    else if (c == quote)
      quote = '\0';
  }
  return std::string_view::npos;
}

bool is_whole_svg(const std::string& path) {
  const std::string text = all_of(path);
  if (text.find('\0') != std::string::npos) return false;
  std::vector<std::string_view> open;
  bool has_root = false;
  for (std::size_t at = text.find('<'); at != std::string::npos;) {
    const std::size_t end = end_of_tag(text, at);
    if (end == std::string::npos) return false;
    const std::string_view tag = std::string_view(text).substr(at + 1, end - at - 2);
    const std::string_view name = tag.substr(0, tag.find_first_of(" \t\r\n/", 1));
    if (tag.starts_with('/')) {
      if (open.empty() || open.back() != name.substr(1)) return false;
      open.pop_back();
    } else if (!tag.starts_with('?') && !tag.starts_with('!') && !tag.ends_with('/')) {
      if (open.empty() && (has_root || name != "svg")) return false;
      has_root = true;
      open.push_back(name);
    }
    at = text.find('<', end);
  }
  return has_root && open.empty();
}

}  // namespace

bool is_whole_file(const std::string& path, const std::string& name) {
  if (name.ends_with(".png")) return is_whole_png(path);
  if (name.ends_with(".mp4")) return is_whole_mp4(path);
  if (name.ends_with(".webm")) return is_whole_webm(path);
  if (name.ends_with(".gif")) return is_whole_gif(path);
  if (name.ends_with(".pdf")) return is_whole_pdf(path);
  if (name.ends_with(".svg")) return is_whole_svg(path);
  throw Error(ExitCode::internal, name + ": nothing is known of files of this kind");
}

}  // namespace talus
