#include "app/command_line.h"

#include <fstream>

namespace talus {
namespace {

std::string quoted_for_shell(const std::string& word) {
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./,=:+%@";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace

std::string command_line() {
  std::ifstream words("/proc/self/cmdline");
  words.exceptions(std::ios::badbit);  // where memory is missing
  std::string text = "talus";
  std::string word;
  std::getline(words, word, '\0');  // the program, wherever it lies
  while (std::getline(words, word, '\0')) text.append(" ").append(quoted_for_shell(word));
  return text;
}

}  // namespace talus
