#include "app/command_line.h"

#include <fmt/core.h>
#include <fstream>

#include "base/text.h"

namespace talus::app {

std::string command_line() {
  std::ifstream words("/proc/self/cmdline");
  words.exceptions(std::ios::badbit);  // where memory is missing
  std::string text = "talus";
  std::string word;
  std::getline(words, word, '\0');  // the program, wherever it lies
  while (std::getline(words, word, '\0')) text += fmt::format(" {}", shell_quoted(word));
  return text;
}

}  // namespace talus::app
