#include "unit/house/source_tree.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "support/places.h"

namespace talus::house {
namespace fs = std::filesystem;
namespace {

const fs::path root = test::source_folder();

/// Returns the text of a file, without lines and path if the file is not text.
TextFile read_text(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::stringstream content;
  content << stream.rdbuf();
  if (content.view().find('\0') != std::string_view::npos) return {};
  TextFile file{path.lexically_relative(root).generic_string(), {}};
  for (std::string line; std::getline(content, line);) file.lines.push_back(line);
  return file;
}

/// Adds the file; each file is read once, because most tests request all of them.
void add_text(const fs::path& path, std::vector<TextFile>& texts) {
  static std::map<fs::path, TextFile> seen;
  auto at = seen.find(path);
  if (at == seen.end()) at = seen.emplace(path, read_text(path)).first;
  if (!at->second.path.empty()) texts.push_back(at->second);
}

bool is_part_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

}  // namespace

std::vector<TextFile> read_texts(const std::vector<std::string>& folders) {
  std::vector<TextFile> texts;
  for (const std::string& folder : folders) {
    if (!fs::exists(root / folder)) continue;
    if (folder == ".") {
      for (const auto& entry : fs::directory_iterator(root))
        if (entry.is_regular_file()) add_text(entry.path(), texts);
    } else {
      for (const auto& entry : fs::recursive_directory_iterator(root / folder))
        if (entry.is_regular_file()) add_text(entry.path(), texts);
    }
  }
  std::ranges::sort(texts, {}, &TextFile::path);
  return texts;
}

bool is_source(const TextFile& file) {
  const std::string extension = fs::path(file.path).extension().string();
  return extension == ".cpp" || extension == ".h" || extension == ".inc" || extension == ".vert" ||
         extension == ".frag" || extension == ".glsl";
}

bool has_word(std::string_view line, std::string_view word) {
  for (auto at = line.find(word); at != std::string_view::npos; at = line.find(word, at + 1)) {
    const auto end = at + word.size();
    if ((at == 0 || !is_part_of_word(line[at - 1])) && (end == line.size() || !is_part_of_word(line[end])))
      return true;
  }
  return false;
}

std::string place(const TextFile& file, std::size_t line_index) {
  return file.path + ":" + std::to_string(line_index + 1) + ": " + file.lines[line_index];
}

}  // namespace talus::house
