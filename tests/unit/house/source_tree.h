#pragma once
/// Files of the checkout, read as text, for the tests of the coding rules.

#include <string>
#include <string_view>
#include <vector>

namespace talus::house {

struct TextFile {
  std::string path;  ///< relative to the root of the checkout, with forward slashes
  std::vector<std::string> lines;
};

/// Returns the text files below `folders`, sorted by path. The folder "." means the files at the root only. A
/// missing folder yields nothing; a file with a zero byte is not text and is left out.
std::vector<TextFile> read_texts(const std::vector<std::string>& folders);

/// Returns whether the file is a C++ source or a shader.
bool is_source(const TextFile& file);

/// Returns whether `word` occurs in `line` without an adjacent letter, digit or underscore.
bool has_word(std::string_view line, std::string_view word);

/// Returns "path:line: text", the place of a violation.
std::string place(const TextFile& file, std::size_t line_index);

}  // namespace talus::house
