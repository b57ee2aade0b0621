#pragma once
/// The files of the checkout, read as text, for the tests of the house's own rules.

#include <string>
#include <string_view>
#include <vector>

namespace talus::house {

struct TextFile {
  std::string path;  ///< from the root of the checkout, with forward slashes
  std::vector<std::string> lines;
};

/// The text files below `folders`, in the order of their paths. The folder "." gives the files at the root
/// only. A folder that does not exist gives nothing; a file that holds a zero byte is not text and is left
/// out.
std::vector<TextFile> read_texts(const std::vector<std::string>& folders);

/// C++ sources and shaders.
bool is_source(const TextFile& file);

/// Whether `word` occurs in `line` with no letter, digit or underscore beside it.
bool has_word(std::string_view line, std::string_view word);

/// "path:line: text", to show where a rule is broken.
std::string place(const TextFile& file, std::size_t line_index);

}  // namespace talus::house
