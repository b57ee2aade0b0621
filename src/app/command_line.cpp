#include "app/command_line.h"

#include <fmt/core.h>
#include <fstream>

#include "base/text.h"

namespace talus::app {

std::string command_line() {
  std::ifstream words("/proc/self/cmdline");
  words.exceptions(std::ios::badbit);  // so that a lack of memory is reported
  std::string text = "talus";
  std::string word;
  std::getline(words, word, '\0');  // skips the path of the program
  while (std::getline(words, word, '\0')) text += fmt::format(" {}", shell_quoted(word));
  return text;
}

}  // namespace talus::app
