#pragma once
/// Text read word by word or line by line.

#include <sstream>
#include <string>

namespace talus {

/// Returns a stream over a text that throws if memory is missing. Other streams only set a bit, as if the
/// text had ended.
inline std::istringstream text_stream(const std::string& text) {
  std::istringstream stream(text);
  stream.exceptions(std::ios::badbit);
  return stream;
}

}  // namespace talus
