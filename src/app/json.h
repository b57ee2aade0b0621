#pragma once
/// JSON as commands print it.

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace talus::app {

/// A value of JSON; the members of an object stay in the order in which they were added.
using Json = nlohmann::ordered_json;

/// Objects with one member a line, `depth` levels deep; arrays in one line. Numbers have the shortest digits
/// that read back as the same number, and are null for NaN; bytes that are no UTF-8 become U+FFFD.
std::string json_text(const Json& value, std::size_t depth = 0);

/// An object of names and values.
template <typename Value>
Json object_of(const std::vector<std::pair<std::string, Value>>& members) {
  Json object = Json::object();
  for (const auto& [name, value] : members) object[name] = value;
  return object;
}

}  // namespace talus::app
