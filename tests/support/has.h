#pragma once
/// Parts of texts.

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace talus::test {

/// Returns whether a text has all of these parts; a failure shows the text and what it lacks.
inline testing::AssertionResult has_all(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    if (text.find(part) == std::string::npos)
      return testing::AssertionFailure() << "\"" << part << "\" is not in:\n" << text;
  return testing::AssertionSuccess() << text;
}

inline testing::AssertionResult has(const std::string& text, const std::string& part) {
  return has_all(text, {part});
}

/// Returns how often a text has a part.
inline std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace talus::test
