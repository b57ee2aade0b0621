#include "app/terminal.h"

#include <cstdarg>
#include <cstdio>
#include <string>

#include "base/visible_text.h"

namespace talus::app {
namespace {

void write(std::FILE* stream, std::string_view text) {
  const std::string shown = visible(text);
  std::fwrite(shown.data(), 1, shown.size(), stream);
}

void write_formatted(std::FILE* stream, const char* format, std::va_list values) {
  std::va_list again;
  va_copy(again, values);
  const int length = std::vsnprintf(nullptr, 0, format, values);
  std::string text(static_cast<std::size_t>(length < 0 ? 0 : length) + 1, '\0');
  std::vsnprintf(text.data(), text.size(), format, again);
  va_end(again);
  text.pop_back();
  write(stream, text);
}

}  // namespace

void print(const char* format, ...) {
  std::va_list values;
  va_start(values, format);
  write_formatted(stdout, format, values);
  va_end(values);
}

void print_error(const char* format, ...) {
  std::va_list values;
  va_start(values, format);
  write_formatted(stderr, format, values);
  va_end(values);
}

void print_text(std::string_view text) { write(stdout, text); }

void print_status(std::string_view line, bool rewrite) {
  if (rewrite) std::fputs("\r\033[K", stderr);
  write(stderr, line);
  if (!rewrite) std::fputc('\n', stderr);
}

}  // namespace talus::app
