#pragma once
/// Rows of keys as the documentation lists them.

#include <filesystem>
#include <fstream>
#include <string>

#include "scenario/key.h"
#include "support/places.h"

namespace talus {

/// Returns the row of a key with this default.
inline std::string row_text(const scenario::KeyHead& key, const std::string& by_default) {
  return "| `" + scenario::full_name(key) + "` | " + (key.unit.empty() ? "-" : key.unit) + " | `" +
         by_default + "` | " + scenario::range_text(key) + " | " + key.help + " |\n";
}

/// Returns all rows of keys on a page of the documentation.
inline std::string rows_of(const std::string& path) {
  std::string rows;
  std::ifstream page(std::filesystem::path(test::source_folder()) / path);
  for (std::string line; std::getline(page, line);)
    if (line.starts_with("| `") && !line.starts_with("| `/")) rows += line + "\n";
  return rows;
}

}  // namespace talus
