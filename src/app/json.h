#pragma once
/// Facts that commands print as text or as JSON.

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace talus::app {

/// A JSON value; members of an object keep the order of insertion.
using Json = nlohmann::ordered_json;

/// Returns JSON text with one object member per line, `depth` levels deep, and arrays on one line. Numbers
/// have the shortest digits that read back, and are null for NaN; invalid UTF-8 becomes U+FFFD.
std::string json_text(const Json& value, std::size_t depth = 0);

/// Returns an object of names and values.
template <typename Value>
Json object_of(const std::vector<std::pair<std::string, Value>>& members) {
  Json object = Json::object();
  for (const auto& [name, value] : members) object[name] = value;
  return object;
}

/// A fact: a line of a text, a member of a JSON object, or both.
struct Fact {
  std::string label;     ///< label of the line; empty: no line
  std::string text;      ///< text of the line, or of several
  std::string key = {};  ///< name of the member; empty: no member
  Json value = {};
};

/// Returns the text of a number, e.g. with the format "{:.3g}"; "none" for NaN.
std::string number_text(double value, const char* format = "{:.4g}");

/// Returns the members as a JSON object, and the lines with their labels in a column of this width.
Json members_of(const std::vector<Fact>& facts);
std::string lines_of(const std::vector<Fact>& facts, int width, const std::string& margin = "");

/// Prints the facts as JSON or as lines.
void print_facts(const std::vector<Fact>& facts, bool json, int width, const std::string& margin = "");

}  // namespace talus::app
