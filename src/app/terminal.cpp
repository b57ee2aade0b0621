#include "app/terminal.h"

#include <cstdio>
#include <string>

#include "base/text.h"

namespace talus::app {
namespace {

void write(std::FILE* stream, std::string_view text) {
  const std::string shown = visible(text);
  std::fwrite(shown.data(), 1, shown.size(), stream);
}

}  // namespace

void print_text(std::string_view text) { write(stdout, text); }
void print_error_text(std::string_view text) { write(stderr, text); }

void print_status(std::string_view line, bool rewrite) {
  if (rewrite) std::fputs("\r\033[K", stderr);
  write(stderr, line);
  if (!rewrite) std::fputc('\n', stderr);
}

}  // namespace talus::app
