#include "app/json.h"

#include <cmath>
#include <fmt/core.h>

#include "app/terminal.h"
#include "base/text.h"
#include "scenario/text.h"

namespace talus::app {

std::string json_text(const Json& value, std::size_t depth) {
  if (value.is_array())
    return fmt::format("[{}]", joined(value, ", ", [&](const Json& item) { return json_text(item, depth); }));
  if (value.is_object()) {
    const std::string margin(2 * depth, ' ');
    std::string text = "{";
    for (const auto& [name, member] : value.items())
      text += fmt::format("{}\n{}  {}: {}", text.size() > 1 ? "," : "", margin, quoted_utf8(name),
                          json_text(member, depth + 1));
    return fmt::format("{}\n{}}}", text, margin);
  }
  if (value.is_string()) return quoted_utf8(value.get_ref<const std::string&>());
  if (value.is_number_float())
    return std::isfinite(value.get<double>()) ? scenario::short_text(value.get<double>()) : "null";
  return value.dump();
}

std::string number_text(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : "none";
}

Json members_of(const std::vector<Fact>& facts) {
  Json object = Json::object();
  for (const Fact& fact : facts)
    if (!fact.key.empty()) object[fact.key] = fact.value;
  return object;
}

std::string lines_of(const std::vector<Fact>& facts, int width, const std::string& margin) {
  std::string lines;
  for (const Fact& fact : facts) {
    const bool continues = !fact.text.empty() && fact.text.front() != '\n';
    if (!fact.label.empty())
      lines += fmt::format("{}{:<{}}{}\n", margin, fact.label, continues ? width : 0, fact.text);
  }
  return lines;
}

void print_facts(const std::vector<Fact>& facts, bool json, int width, const std::string& margin) {
  print_text(json ? json_text(members_of(facts)) + "\n" : lines_of(facts, width, margin));
}

}  // namespace talus::app
