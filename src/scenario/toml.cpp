/// Parser of scenarios and settings: TOML to values and fields, with the place of errors.

#include <fcntl.h>
#include <sys/stat.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <fmt/core.h>
#include <map>
#include <new>
#include <span>

#include "base/errors.h"
#include "base/output_file.h"
#include "base/text.h"
#include "scenario/key.h"
#include "scenario/keys.h"
#include "scenario/scripted_command.h"
#include "scenario/text.h"

namespace talus::scenario {
namespace {

constexpr std::size_t largest_file = std::size_t{1} << 20;  // bytes
constexpr std::size_t max_complaints = 100;                 // largest number reported at once
constexpr std::ptrdiff_t max_dots = 1000;                   // largest number in a line

/// Place of a value: in the file, or in a setting of the command line.
struct SourcePlace {
  std::string text;  ///< "slope.toml:4:11", "--set contact.friction=-1"
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  bool in_file = false;
};

struct Complaint {
  SourcePlace place;
  std::string message;
};

/// A key that has been given a value.
struct KeyEntry {
  SourcePlace place;
  std::optional<KeyValue> value;  ///< empty if the value is not accepted
};

/// A scenario, or settings, during parsing.
struct ParsedKeys {
  KeyHeads keys;
  std::string example;  ///< example of a setting
  std::string name;     ///< name of the file
  std::map<const KeyHead*, KeyEntry> given;
  std::vector<Complaint> complaints;
  /// Keys of each [[command]]; `keys` contains them as well.
  std::vector<std::vector<CommandKey>> commands{};

  template <typename... Args>
  void complain(const SourcePlace& place, fmt::format_string<Args...> message, Args&&... args) {
    complaints.push_back({place, fmt::format(message, std::forward<Args>(args)...)});
  }
};

SourcePlace place_in_file(const std::string& name, toml::source_position at) {
  return {fmt::format("{}:{}:{}", name, at.line, at.column), at.line, at.column, true};
}

std::string line_of(const SourcePlace& place, const std::string& message) {
  return fmt::format("{}: error: {}", place.text, message);
}

[[noreturn]] void refuse(const SourcePlace& place, const std::string& message) {
  throw LocatedError(ExitCode::bad_data, line_of(place, message));
}

/// Throws an error with all complaints, ordered by their place in the file, followed by those about settings.
[[noreturn]] void refuse(std::vector<Complaint> complaints, const std::string& name) {
  std::ranges::stable_sort(complaints, [](const Complaint& first, const Complaint& second) {
    const auto order = [](const SourcePlace& p) { return std::tuple(!p.in_file, p.line, p.column); };
    return order(first.place) < order(second.place);
  });
  std::string text =
      joined(std::span(complaints).first(std::min(complaints.size(), max_complaints)), "\n",
             [](const Complaint& complaint) { return line_of(complaint.place, complaint.message); });
  if (complaints.size() > max_complaints)
    text += fmt::format("\n{}: error: and {} more", name, complaints.size() - max_complaints);
  throw LocatedError(ExitCode::bad_data, text);
}

std::string kind_of(const toml::node& node) {
  using enum toml::node_type;
  static const std::map<toml::node_type, std::string> kinds = {
      {table, "a table"},      {array, "an array"},         {string, "a string"},
      {integer, "an integer"}, {floating_point, "a float"}, {boolean, "a boolean"}};
  const auto kind = kinds.find(node.type());
  return kind == kinds.end() ? "a date or time" : kind->second;
}

std::optional<KeyValue> value_of(const toml::node& node) {
  if (const auto* whole = node.as_integer()) return whole->get();
  if (const auto* number = node.as_floating_point()) return number->get();
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* truth = node.as_boolean()) return truth->get();
  const toml::array* array = node.as_array();
  if (array == nullptr) return std::nullopt;
  if (!array->empty() && array->is_homogeneous(toml::node_type::string)) {
    std::vector<std::string> texts;
    for (const toml::node& element : *array) texts.push_back(element.as_string()->get());
    return texts;
  }
  std::vector<double> numbers;
  for (const toml::node& element : *array)
    if (const auto number = element.value<double>(); number && element.is_number())
      numbers.push_back(*number);
    else
      return std::nullopt;
  return numbers;
}

/// Returns " = 0.5" for the value of a node; empty for a value that does not fit into a line.
std::string shown(const toml::node& node) {
  if (const auto* text = node.as_string()) return fmt::format(" = \"{}\"", visible_word(text->get()));
  const auto value = node.is_array() ? std::nullopt : value_of(node);
  return value ? " = " + toml_text(*value) : "";
}

bool is_of_expected_kind(const KeyHead& key, const toml::node& node) {
  if (std::holds_alternative<Choices>(key.range) || std::holds_alternative<TextRange>(key.range))
    return node.is_string();
  if (std::holds_alternative<IntegerRange>(key.range)) return node.is_integer();
  if (std::holds_alternative<Switch>(key.range)) return node.is_boolean();
  if (std::holds_alternative<NumberList>(key.range)) return node.is_array();
  if (std::holds_alternative<PhraseList>(key.range)) return node.is_array() || node.is_string();
  return node.is_number() || (node.is_string() && !std::get<NumberRange>(key.range).word.empty());
}

/// Returns the words that are allowed as the value of a key.
std::vector<std::string> words_of(const KeyHead& key) {
  if (const auto* choices = std::get_if<Choices>(&key.range)) return choices->names;
  if (const auto* range = std::get_if<NumberRange>(&key.range)) return {range->word};
  if (const auto* list = std::get_if<PhraseList>(&key.range)) return {list->word};
  return {};
}

/// Adds a complaint for each invalid phrase of a list; returns whether there is one.
bool complain_of_phrases(ParsedKeys& reading, const KeyHead& key, const toml::node& node,
                         const SourcePlace& place) {
  const auto* list = std::get_if<PhraseList>(&key.range);
  const toml::array* array = node.as_array();
  if (list == nullptr || array == nullptr) return false;
  bool any = false;
  for (const toml::node& element : *array) {
    const auto* text = element.as_string();
    if (text != nullptr && list->good(text->get())) continue;
    any = true;
    const SourcePlace at = place.in_file ? place_in_file(reading.name, element.source().begin) : place;
    reading.complain(at, "key '{}'{}: expected {}{}", full_name(key), shown(element), list->forms,
                     text != nullptr ? list->meant(text->get()) : ", found " + kind_of(element));
  }
  return any;
}

void take_value(ParsedKeys& reading, const KeyHead& key, const toml::node& node, const SourcePlace& place) {
  const auto found = value_of(node);
  const auto good = found ? admitted(key, *found) : std::nullopt;
  reading.given[&key] = {place, good};
  if (!good && !complain_of_phrases(reading, key, node, place))
    reading.complain(place, "key '{}'{}: expected {}{}{}", full_name(key), shown(node), expectation(key),
                     is_of_expected_kind(key, node) ? "" : ", found " + kind_of(node),
                     node.is_string() ? did_you_mean(node.as_string()->get(), words_of(key)) : "");
}

/// Reads a table. Sections are tables at the top level (`section` empty); all other entries are keys. `keys`
/// are those allowed in the table.
void take_table(ParsedKeys& reading, const KeyHeads& keys, const toml::table& table,
                const std::string& section) {
  const std::vector<std::string> sections = sections_of(keys);
  for (const auto& [name, node] : table) {
    const SourcePlace at_name = place_in_file(reading.name, name.source().begin);
    const SourcePlace at_value = place_in_file(reading.name, node.source().begin);
    const std::string word(name.str());
    const KeyHead* key = find_key(keys, section.empty() ? word : section + "." + word);
    if (key != nullptr) {
      if (!reading.given.contains(key)) take_value(reading, *key, node, at_value);
    } else if (section.empty() && !reading.commands.empty() && word == "command") {
      // read by take_commands
    } else if (section.empty() && std::ranges::find(sections, word) != sections.end()) {
      if (node.is_table())
        take_table(reading, keys, *node.as_table(), word);
      else
        reading.complain(at_value, "key '{}'{}: expected a section [{}], found {}", word, shown(node), word,
                         kind_of(node));
    } else {
      const bool new_section = section.empty() && (node.is_table() || node.is_array_of_tables());
      reading.complain(at_name, "{}",
                       new_section ? unknown_key(keys, word, "") : unknown_key(keys, section, word));
    }
  }
}

/// Returns the message of the TOML library, reworded for the most frequent errors.
std::string syntax_message(const toml::parse_error& error) {
  const std::string_view said = error.description();
  const auto again = said.find("cannot redefine");
  if (again != std::string_view::npos)
    return fmt::format("this name occurs twice: {}; expected it once", visible_word(said.substr(again), 200));
  const bool bare_word = said.ends_with("could not determine value type");
  return fmt::format("not valid TOML: {}{}", visible_word(said, 200),
                     bare_word ? "; expected a number, true, false, or a string in quotes" : "");
}

/// Parses TOML. Out of memory, the TOML library reports an invalid number; errno distinguishes the two cases.
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

/// Returns the number of the first line, counted from 1, whose dots could nest tables deeper than the stack
/// of the parser allows; 0 if there is none.
std::uint32_t line_too_deep(std::string_view text) {
  for (std::uint32_t line = 1;; ++line) {
    const auto end = text.find('\n');
    if (std::ranges::count(text.substr(0, end), '.') > max_dots) return line;
    if (end == std::string_view::npos) return 0;
    text.remove_prefix(end + 1);
  }
}

/// Wraps a number in a table, like a parsed value.
toml::table table_of(const KeyValue& number) {
  if (const auto* whole = std::get_if<std::int64_t>(&number)) return toml::table{{"value", *whole}};
  return toml::table{{"value", std::get<double>(number)}};
}

/// Wraps comma-separated phrases without quotes in a table, like a parsed value.
toml::table table_of_phrases(std::string_view text) {
  toml::array phrases;
  while (true) {
    const auto comma = text.find(',');
    phrases.push_back(std::string(trimmed(text.substr(0, comma))));
    if (comma == std::string_view::npos) return toml::table{{"value", std::move(phrases)}};
    text.remove_prefix(comma + 1);
  }
}

/// Whether a word may be used as a string without quotes.
bool is_bare_word(std::string_view text) {
  return !text.empty() &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; }) &&
         std::isalpha(static_cast<unsigned char>(text.front()));
}

/// Returns the number that a value means for this key if TOML does not read it: ".3", "1.", "007", the unit
/// of the key after the number ("20 D"), and for an integer also "1e5". Empty for other text and other keys.
std::optional<KeyValue> typed_number(const KeyHead& key, std::string_view value) {
  const bool is_whole = std::holds_alternative<IntegerRange>(key.range);
  if (!is_whole && !std::holds_alternative<NumberRange>(key.range)) return std::nullopt;
  if (!key.unit.empty() && value.ends_with(key.unit))
    value = trimmed(value.substr(0, value.size() - key.unit.size()));
  if (value.starts_with('+')) value.remove_prefix(1);
  const auto number = parse_number<double>(value);
  if (!number || !std::isfinite(*number)) return std::nullopt;
  if (!is_whole) return *number;
  // Smallest double beyond which not every integer is representable.
  constexpr double largest = 9007199254740992.0;
  if (*number != std::floor(*number) || std::abs(*number) >= largest) return std::nullopt;
  return static_cast<std::int64_t>(*number);
}

/// Parses the value of a setting: TOML, a number as people type it, a list without brackets, or a bare word
/// as a string; for a key that takes any text, also text that is not TOML (`--set
/// deposition.file=beds/dense.csv`). Returns a table with one entry, "value"; empty if the value has none of
/// these forms.
std::optional<toml::table> parse_setting(const KeyHead& key, const std::string& value) {
  if (line_too_deep(value) != 0) return std::nullopt;
  const bool bare_list = std::holds_alternative<NumberList>(key.range) && !value.starts_with('[');
  if (const auto* list = std::get_if<PhraseList>(&key.range); list != nullptr && value != list->word)
    if (value.find_first_of("[\"'") == std::string::npos) return table_of_phrases(value);
  try {
    toml::table table = parse_toml("value = " + (bare_list ? fmt::format("[{}]", value) : value));
    const bool may_be_whole =
        std::holds_alternative<IntegerRange>(key.range) && table.get("value")->is_floating_point();
    const auto whole = may_be_whole ? typed_number(key, value) : std::nullopt;
    if (table.size() == 1) return whole ? table_of(*whole) : table;
  } catch (const toml::parse_error&) {
    if (const auto number = typed_number(key, value)) return table_of(*number);
    if (is_bare_word(value) || std::holds_alternative<TextRange>(key.range))
      return toml::table{{"value", value}};
  }
  return std::nullopt;
}

/// Returns a message about an unknown key of a setting.
std::string unknown_setting(const KeyHeads& keys, const std::string& name) {
  if (name.starts_with("command."))
    return fmt::format(
        "unknown key '{}': expected command.N.KEY with N from 1 to the number of [[command]] tables of the "
        "scenario, and KEY one of at, time, kind, grain, x and y",
        visible_word(name));
  const auto dot = sections_of(keys).empty() ? std::string::npos : name.find('.');
  return dot == std::string::npos ? unknown_key(keys, "", name)
                                  : unknown_key(keys, name.substr(0, dot), name.substr(dot + 1));
}

/// Reads a setting of `option`, such as "--set".
void take_setting(ParsedKeys& reading, const std::string& option, const std::string& setting) {
  SourcePlace place;
  place.text = fmt::format("{} {}", option, visible_word(setting));
  const auto equals = setting.find('=');
  const std::string name(trimmed(std::string_view(setting).substr(0, equals)));
  const std::string value(
      equals == std::string::npos ? "" : trimmed(std::string_view(setting).substr(equals + 1)));
  const KeyHead* key = find_key(reading.keys, name);
  if (name.empty() || value.empty())
    return reading.complain(place, "{}expected {}key=value, such as --set {}",
                            key != nullptr ? fmt::format("key '{}' has no value: ", name) : "",
                            sections_of(reading.keys).empty() ? "" : "section.", reading.example);
  if (key == nullptr) return reading.complain(place, "{}", unknown_setting(reading.keys, name));
  if (reading.given.contains(key))
    return reading.complain(place, "key '{}' is set twice on the command line; expected it once", name);
  if (const auto table = parse_setting(*key, value))
    return take_value(reading, *key, *table->get("value"), place);
  reading.given[key] = {place, std::nullopt};
  reading.complain(place, "key '{}' = {}: expected {}", name, visible_word(value), expectation(*key));
}

/// Registers the keys of the commands of a file, so that settings can name them.
void begin_commands(ParsedKeys& reading, const toml::table& table) {
  const toml::node* node = table.get("command");
  if (node == nullptr) return;
  const toml::array* commands = node->as_array();
  if (commands == nullptr || !commands->is_homogeneous(toml::node_type::table))
    refuse(place_in_file(reading.name, node->source().begin),
           fmt::format("'command' is {}: expected one table [[command]] for each command", kind_of(*node)));
  if (commands->size() > max_commands)
    refuse(place_in_file(reading.name, node->source().begin),
           fmt::format("{} commands: expected at most {}", commands->size(), max_commands));
  for (std::size_t k = 0; k < commands->size(); ++k)
    reading.commands.push_back(command_keys(command_section(k)));
  for (const std::vector<CommandKey>& keys : reading.commands)
    for (const CommandKey& key : keys) reading.keys.push_back(&key);
}

/// Reads the commands whose keys are accepted.
void take_commands(ParsedKeys& reading, const toml::table& table, Scenario& scenario) {
  for (std::size_t k = 0; k < reading.commands.size(); ++k) {
    const toml::node& node = table.get("command")->as_array()->at(k);
    const std::size_t complaints = reading.complaints.size();
    take_table(reading, heads(reading.commands[k]), *node.as_table(), command_section(k));
    ScriptedCommand& command = scenario.commands.emplace_back();
    std::vector<std::string> given;
    bool refused = reading.complaints.size() > complaints;
    for (const CommandKey& key : reading.commands[k]) {
      const auto found = reading.given.find(&key);
      if (found == reading.given.end()) continue;
      refused = refused || !found->second.value;
      if (!found->second.value) continue;
      key.set(command, *found->second.value);
      if (*found->second.value != KeyValue("none")) given.push_back(key.name);
    }
    if (refused) continue;
    if (const std::string fault = table_fault(command, given, scenario); !fault.empty())
      reading.complain(place_in_file(reading.name, node.source().begin), "{} {}", command_section(k), fault);
  }
}

/// Returns the scenario with all accepted keys.
Scenario scenario_of(const ParsedKeys& reading) {
  Scenario scenario;
  for (const ScenarioKey& key : scenario_keys())
    if (const auto found = reading.given.find(&key); found != reading.given.end() && found->second.value)
      key.set(scenario, *found->second.value);
  return scenario;
}

/// Adds complaints about broken rules, at a key that the rule concerns: one set on the command line,
/// otherwise the first one given.
void check_rules(ParsedKeys& reading, const Scenario& scenario) {
  for (const BrokenRule& rule : broken_rules(scenario)) {
    const ScenarioKey* blamed = find_key(rule.keys.front());
    const KeyEntry* at = nullptr;
    bool all_good = true;
    for (const std::string& name : rule.keys) {
      const auto found = reading.given.find(find_key(name));
      if (found == reading.given.end()) continue;
      all_good = all_good && found->second.value.has_value();
      if (at != nullptr && (!at->place.in_file || found->second.place.in_file)) continue;
      blamed = find_key(name);
      at = &found->second;
    }
    if (all_good)
      reading.complain(at != nullptr ? at->place : place_in_file(reading.name, {1, 1}),
                       "key '{}' = {}: expected {}", full_name(*blamed), toml_text(blamed->get(scenario)),
                       rule.expected);
  }
}

/// Throws if the text cannot be TOML, before the parser sees it.
void refuse_binary(const std::string& text, const std::string& name) {
  const auto zero = text.find('\0');
  if (zero != std::string::npos || text.starts_with("talus run file"))
    refuse(place_in_file(name, {1, 1}),
           "this is not a scenario but binary data; expected TOML (see docs/scenario.md). `talus info` shows "
           "the contents of a run");
  if (text.size() > largest_file)
    refuse(place_in_file(name, {1, 1}),
           fmt::format("the file is too large: expected a scenario of at most {} bytes", largest_file));
  if (const std::uint32_t line = line_too_deep(text))
    refuse(place_in_file(name, {line, 1}),
           fmt::format("this line has too many dots: expected at most {}", max_dots));
}

}  // namespace

std::map<const KeyHead*, KeyValue> read_settings(const KeyHeads& keys,
                                                 const std::vector<std::string>& settings,
                                                 const std::string& example) {
  ParsedKeys reading{keys, example, {}, {}, {}};
  for (const std::string& setting : settings) take_setting(reading, "--set", setting);
  if (!reading.complaints.empty()) refuse(reading.complaints, "--set");
  std::map<const KeyHead*, KeyValue> values;
  for (const auto& [key, given] : reading.given) values.emplace(key, *given.value);
  return values;
}

Scenario parse_scenario(const std::string& text, const std::string& name,
                        const std::vector<std::string>& overrides, const std::vector<std::string>& varied) {
  refuse_binary(text, name);
  const toml::table table = parse_text(text, name);
  ParsedKeys reading{heads(scenario_keys()), "contact.friction=0.3", name, {}, {}};
  begin_commands(reading, table);
  for (const std::string& setting : overrides) take_setting(reading, "--set", setting);
  for (const std::string& setting : varied) take_setting(reading, "--vary", setting);
  take_table(reading, heads(scenario_keys()), table, "");
  Scenario scenario = scenario_of(reading);
  take_commands(reading, table, scenario);
  check_rules(reading, scenario);
  if (!reading.complaints.empty()) refuse(reading.complaints, name);
  return scenario;
}

Scenario read_scenario(const std::string& path, const std::vector<std::string>& overrides, std::string* text,
                       const std::vector<std::string>& varied) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) throw system_error(ExitCode::missing_input, "read", path, errno);
  struct stat status {};
  const bool known = ::fstat(file.get(), &status) == 0;
  if (known && S_ISDIR(status.st_mode))
    throw Error(ExitCode::missing_input, "{} is a folder; expected a scenario file (TOML)", path);
  std::string content(largest_file + 1, '\0');
  content.resize(read_at_most(file, std::as_writable_bytes(std::span(content)), path));
  // A pipe that has been read is empty, and must not count as a scenario with all defaults.
  if (known && !S_ISREG(status.st_mode) && content.empty())
    throw Error(ExitCode::missing_input,
                "{} is an empty pipe or device; save the scenario to a file and give its path", path);
  if (text != nullptr) *text = content;
  return parse_scenario(content, path, overrides, varied);
}

}  // namespace talus::scenario
