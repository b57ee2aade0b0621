#pragma once
/// JSON output of commands.

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace talus::app {

/// A JSON value; members of an object keep the order of insertion.
using Json = nlohmann::ordered_json;

/// Returns JSON text with one object member per line, `depth` levels deep, and arrays on one line. Numbers
/// have the shortest digits that read back as the same number, and are null for NaN; invalid UTF-8 becomes
/// U+FFFD.
std::string json_text(const Json& value, std::size_t depth = 0);

/// Returns an object of names and values.
template <typename Value>
Json object_of(const std::vector<std::pair<std::string, Value>>& members) {
  Json object = Json::object();
  for (const auto& [name, value] : members) object[name] = value;
  return object;
}

}  // namespace talus::app
