#include "base/text.h"

#include <numbers>

#include "base/visible_text.h"

namespace talus {

std::string fixed_text(double value, int decimals) {
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  return text.starts_with('-') && text.find_first_of("123456789n") == std::string::npos ? text.substr(1)
                                                                                        : text;
}

std::string degrees_text(double angle, int decimals) {
  return fixed_text(angle * (180.0 / std::numbers::pi), decimals);
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string xml_text(std::string_view text) {
  std::string result;
  for (const char c : text)
    if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '&')
      result += "&amp;";
    else
      result += c;
  return result;
}

std::string csv_quoted(const std::string& text) {
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

std::string shell_quoted(const std::string& word) {
  const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./,=:+%@";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  if (visible(word) != word || word.find('\n') != std::string::npos) {
    std::string escaped = "$'";
    for (const char c : word) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == '\'' || c == '\\') escaped += '\\';
      if (byte < 0x20 || byte > 0x7e)
        escaped += fmt::format("\\x{:02x}", byte);
      else
        escaped += c;
    }
    return escaped + "'";
  }
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace talus
