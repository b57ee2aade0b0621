/// Reading a scenario: TOML to values, values to fields, and every error with its place.

#include <fcntl.h>
#include <sys/stat.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <map>
#include <new>
#include <span>

#include "core/descriptor.h"
#include "core/errors.h"
#include "session/scenario_keys.h"
#include "session/scenario_rules.h"
#include "session/scenario_suggestion.h"
#include "session/scenario_text.h"

namespace talus {
namespace {

constexpr std::size_t largest_file = std::size_t{1} << 20;  // bytes
constexpr std::size_t most_complaints = 100;                // shown at once
constexpr std::ptrdiff_t most_dots = 1000;                  // in a line

/// Where a value stands: in the file, or in a setting of the command line.
struct Place {
  std::string text;  ///< "slope.toml:4:11", "--set contact.friction=-1"
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  bool in_file = false;
};

struct Complaint {
  Place place;
  std::string message;
};

/// A key that has been given a value.
struct Given {
  Place place;
  bool good = false;
};

/// A scenario while it is read.
struct Reading {
  std::string name;  ///< of the file
  Scenario scenario;
  std::map<const ScenarioKey*, Given> given;
  std::vector<Complaint> complaints;

  void complain(const Place& place, const std::string& message) { complaints.push_back({place, message}); }
};

Place place_in_file(const std::string& name, toml::source_position at) {
  return {name + ":" + std::to_string(at.line) + ":" + std::to_string(at.column), at.line, at.column, true};
}

std::string line_of(const Place& place, const std::string& message) {
  return place.text + ": error: " + message;
}

[[noreturn]] void refuse(const Place& place, const std::string& message) {
  throw LocatedError(ExitCode::bad_data, line_of(place, message));
}

/// All complaints by their place in the file, then those about settings in the order of these.
[[noreturn]] void refuse(std::vector<Complaint> complaints, const std::string& name) {
  std::ranges::stable_sort(complaints, [](const Complaint& first, const Complaint& second) {
    const auto order = [](const Place& p) { return std::tuple(!p.in_file, p.line, p.column); };
    return order(first.place) < order(second.place);
  });
  std::string text;
  for (std::size_t i = 0; i < std::min(complaints.size(), most_complaints); ++i) {
    if (i > 0) text += '\n';
    text += line_of(complaints[i].place, complaints[i].message);
  }
  if (complaints.size() > most_complaints)
    text += "\n" + name + ": error: and " + std::to_string(complaints.size() - most_complaints) + " more";
  throw LocatedError(ExitCode::bad_data, text);
}

std::string kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a float";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

std::optional<ScenarioValue> value_of(const toml::node& node) {
  if (const auto* whole = node.as_integer()) return whole->get();
  if (const auto* number = node.as_floating_point()) return number->get();
  if (const auto* text = node.as_string()) return text->get();
  return std::nullopt;
}

/// " = 0.5"; nothing for what would not fit a line.
std::string shown(const toml::node& node) {
  if (const auto* truth = node.as_boolean()) return truth->get() ? " = true" : " = false";
  if (const auto* text = node.as_string()) return " = \"" + printable(text->get()) + "\"";
  const auto value = value_of(node);
  return value ? " = " + toml_text(*value) : "";
}

bool is_of_expected_kind(const ScenarioKey& key, const toml::node& node) {
  if (std::holds_alternative<Choices>(key.range) || std::holds_alternative<TextRange>(key.range))
    return node.is_string();
  if (std::holds_alternative<IntegerRange>(key.range)) return node.is_integer();
  return node.is_number() || (node.is_string() && !std::get<NumberRange>(key.range).word.empty());
}

void take_value(Reading& reading, const ScenarioKey& key, const toml::node& node, const Place& place) {
  const auto found = value_of(node);
  const auto good = found ? admitted(key, *found) : std::nullopt;
  reading.given[&key] = {place, good.has_value()};
  if (good)
    key.set(reading.scenario, *good);
  else
    reading.complain(place, "key '" + full_name(key) + "'" + shown(node) + ": expected " + expectation(key) +
                                (is_of_expected_kind(key, node) ? "" : ", found " + kind_of(node)));
}

bool is_section(std::string_view name) {
  return std::ranges::any_of(
      scenario_keys(), [&](const ScenarioKey& key) { return !key.section.empty() && key.section == name; });
}

std::string joined_name(std::string_view section, std::string_view name) {
  return section.empty() ? std::string(name) : std::string(section) + "." + std::string(name);
}

std::string unknown_key(std::string_view section, std::string_view name) {
  return "unknown key '" + printable(joined_name(section, name)) + "'" + suggest_key(section, name);
}

std::string unknown_section(std::string_view name) {
  return "unknown section [" + printable(name) + "]" + suggest_section(name);
}

/// Sections are tables at the top level (`section` empty), keys are what else there is.
void take_table(Reading& reading, const toml::table& table, const std::string& section) {
  for (const auto& [name, node] : table) {
    const Place at_name = place_in_file(reading.name, name.source().begin);
    const Place at_value = place_in_file(reading.name, node.source().begin);
    const ScenarioKey* key = find_key(joined_name(section, name.str()));
    if (key != nullptr) {
      if (!reading.given.contains(key)) take_value(reading, *key, node, at_value);
    } else if (section.empty() && is_section(name.str())) {
      if (node.is_table())
        take_table(reading, *node.as_table(), std::string(name.str()));
      else
        reading.complain(at_value, "key '" + std::string(name.str()) + "'" + shown(node) +
                                       ": expected a section [" + std::string(name.str()) + "], found " +
                                       kind_of(node));
    } else {
      const bool new_section = section.empty() && (node.is_table() || node.is_array_of_tables());
      reading.complain(at_name, new_section ? unknown_section(name.str()) : unknown_key(section, name.str()));
    }
  }
}

/// The message of the TOML library, in plainer words where users will meet it most.
std::string syntax_message(const toml::parse_error& error) {
  const std::string_view said = error.description();
  const auto again = said.find("cannot redefine");
  if (again != std::string_view::npos)
    return "this name stands twice: " + printable(said.substr(again), 200) + "; expected it once";
  const bool bare_word = said.ends_with("could not determine value type");
  return "not valid TOML: " + printable(said, 200) +
         (bare_word ? "; expected a number, true, false, or a string in quotes" : "");
}

/// The TOML library takes a number for none where the memory to read it is missing; errno tells.
template <typename... Arguments>
toml::table parse_toml(const Arguments&... text) {
  errno = 0;
  try {
    return toml::parse(text...);
  } catch (const toml::parse_error&) {
    if (errno == ENOMEM) throw std::bad_alloc();
    throw;
  }
}

toml::table parse_text(const std::string& text, const std::string& name) {
  try {
    return parse_toml(std::string_view(text), std::string_view(name));
  } catch (const toml::parse_error& error) {
    refuse(place_in_file(name, error.source().begin), syntax_message(error));
  }
}

bool is_bare_word(std::string_view text) {
  return !text.empty() &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; }) &&
         std::isalpha(static_cast<unsigned char>(text.front()));
}

/// The first line, from 1, with so many dots that its name could be a table in a table in a table ... deeper
/// than the stack of the parser; 0 where there is none.
std::uint32_t line_too_deep(std::string_view text) {
  for (std::uint32_t line = 1;; ++line) {
    const auto end = text.find('\n');
    if (std::ranges::count(text.substr(0, end), '.') > most_dots) return line;
    if (end == std::string_view::npos) return 0;
    text.remove_prefix(end + 1);
  }
}

/// The value of a setting: TOML, or a bare word that stands for a string; of a key that takes any text, also
/// what is no TOML (`--set deposition.file=beds/dense.csv`). One entry, named "value"; nothing where it is
/// none of these.
std::optional<toml::table> parse_setting(const ScenarioKey& key, const std::string& value) {
  if (line_too_deep(value) != 0) return std::nullopt;
  try {
    toml::table table = parse_toml("value = " + value);
    if (table.size() == 1) return table;
  } catch (const toml::parse_error&) {
    if (is_bare_word(value) || std::holds_alternative<TextRange>(key.range))
      return toml::table{{"value", value}};
  }
  return std::nullopt;
}

void take_override(Reading& reading, const std::string& setting) {
  Place place;
  place.text = "--set " + printable(setting);
  const auto equals = setting.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == setting.size())
    return reading.complain(place, "expected section.key=value, such as --set contact.friction=0.3");
  const std::string name = setting.substr(0, equals);
  const ScenarioKey* key = find_key(name);
  if (key == nullptr) {
    const auto dot = name.find('.');
    const std::string section = dot == std::string::npos ? "" : name.substr(0, dot);
    const bool new_section = dot != std::string::npos && !is_section(section);
    return reading.complain(place, new_section
                                       ? unknown_section(section)
                                       : unknown_key(section, name.substr(section.empty() ? 0 : dot + 1)));
  }
  if (reading.given.contains(key))
    return reading.complain(place, "key '" + name + "' is set twice on the command line; expected it once");
  if (const auto table = parse_setting(*key, setting.substr(equals + 1)))
    return take_value(reading, *key, *table->get("value"), place);
  reading.given[key] = {place, false};
  reading.complain(place, "key '" + name + "': expected " + expectation(*key) + ", found no value of TOML");
}

/// Complains at the key that a rule is about: one set on the command line, else the first one given.
void check_rules(Reading& reading) {
  for (const BrokenRule& rule : broken_rules(reading.scenario)) {
    const ScenarioKey* blamed = find_key(rule.keys.front());
    const Given* at = nullptr;
    bool all_good = true;
    for (const std::string& name : rule.keys) {
      const auto found = reading.given.find(find_key(name));
      if (found == reading.given.end()) continue;
      all_good = all_good && found->second.good;
      if (at != nullptr && (!at->place.in_file || found->second.place.in_file)) continue;
      blamed = found->first;
      at = &found->second;
    }
    if (all_good)
      reading.complain(at != nullptr ? at->place : place_in_file(reading.name, {1, 1}),
                       "key '" + full_name(*blamed) + "' = " + toml_text(blamed->get(reading.scenario)) +
                           ": expected " + rule.expected);
  }
}

/// Throws where the text cannot be TOML, so that the parser need not be asked.
void refuse_what_is_no_text(const std::string& text, const std::string& name) {
  const auto zero = text.find('\0');
  if (zero != std::string::npos || text.starts_with("talus run file"))
    refuse(place_in_file(name, {1, 1}),
           "this is not a scenario but binary data; expected TOML (see docs/scenario.md). "
           "`talus info` shows what a run holds");
  if (text.size() > largest_file)
    refuse(place_in_file(name, {1, 1}), "the file is too large: expected a scenario of at most " +
                                            std::to_string(largest_file) + " bytes");
  if (const std::uint32_t line = line_too_deep(text))
    refuse(place_in_file(name, {line, 1}),
           "this line has too many dots: expected at most " + std::to_string(most_dots));
}

}  // namespace

Scenario parse_scenario(const std::string& text, const std::string& name,
                        const std::vector<std::string>& overrides) {
  refuse_what_is_no_text(text, name);
  const toml::table table = parse_text(text, name);
  Reading reading{name, {}, {}, {}};
  for (const std::string& setting : overrides) take_override(reading, setting);
  take_table(reading, table, "");
  check_rules(reading);
  if (!reading.complaints.empty()) refuse(reading.complaints, name);
  return reading.scenario;
}

Scenario read_scenario(const std::string& path, const std::vector<std::string>& overrides,
                       std::string* text) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) throw system_error(ExitCode::missing_input, "read", path, errno);
  struct stat status {};
  if (::fstat(file.get(), &status) == 0 && S_ISDIR(status.st_mode))
    throw Error(ExitCode::missing_input, path + " is a folder; expected a scenario file (TOML)");
  std::string content(largest_file + 1, '\0');
  content.resize(read_at_most(file, std::as_writable_bytes(std::span(content)), path));
  if (text != nullptr) *text = content;
  return parse_scenario(content, path, overrides);
}

}  // namespace talus
