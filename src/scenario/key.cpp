#include "scenario/key.h"

#include <cmath>
#include <fmt/core.h>

#include "base/text.h"

namespace talus::scenario {
namespace {

std::string text_of(const NumberRange& range) {
  const std::string low = short_text(range.low);
  const std::string numbers =
      std::isinf(range.high)
          ? fmt::format("a finite number {}{}", range.low_included ? ">= " : "> ", low)
          : fmt::format("a number in {}{}, {}]", range.low_included ? "[" : "(", low, short_text(range.high));
  return range.word.empty() ? numbers : fmt::format("{} or \"{}\"", numbers, range.word);
}

std::string text_of(const IntegerRange& range) {
  return fmt::format("an integer in {} ... {}", range.low, range.high);
}

std::string text_of(const Choices& choices) {
  return fmt::format("\"{}\"", joined(choices.names, "\" or \""));
}

std::string text_of(const TextRange& range) {
  return fmt::format("{} in quotes (UTF-8, at most {} bytes, none of them zero), or \"\" for none",
                     range.what, range.longest);
}

std::string text_of(const Switch&) { return "true or false"; }

std::optional<KeyValue> admitted_by(const Switch&, const KeyValue& value) {
  return std::holds_alternative<bool>(value) ? std::optional(value) : std::nullopt;
}

std::optional<KeyValue> admitted_by(const NumberRange& range, const KeyValue& value) {
  if (const std::string* word = std::get_if<std::string>(&value))
    return !range.word.empty() && *word == range.word ? std::optional(value) : std::nullopt;
  const std::int64_t* whole = std::get_if<std::int64_t>(&value);
  if (whole == nullptr && !std::holds_alternative<double>(value)) return std::nullopt;
  const double number = whole != nullptr ? static_cast<double>(*whole) : std::get<double>(value);
  const bool above = range.low_included ? number >= range.low : number > range.low;
  return std::isfinite(number) && above && number <= range.high ? std::optional<KeyValue>(number)
                                                                : std::nullopt;
}

std::optional<KeyValue> admitted_by(const IntegerRange& range, const KeyValue& value) {
  const std::int64_t* whole = std::get_if<std::int64_t>(&value);
  return whole != nullptr && *whole >= range.low && *whole <= range.high ? std::optional(value)
                                                                         : std::nullopt;
}

std::optional<KeyValue> admitted_by(const Choices& choices, const KeyValue& value) {
  for (const std::string& name : choices.names)
    if (value == KeyValue(name)) return value;
  return std::nullopt;
}

std::optional<KeyValue> admitted_by(const TextRange& range, const KeyValue& value) {
  const std::string* text = std::get_if<std::string>(&value);
  return text != nullptr && text->size() <= range.longest && text->find('\0') == std::string::npos &&
                 utf8(*text) == *text
             ? std::optional(value)
             : std::nullopt;
}

std::string text_of(const NumberList& list) {
  return fmt::format("1 ... {} ascending numbers in (0, {}], with commas between", list.most,
                     short_text(list.high));
}

std::optional<KeyValue> admitted_by(const NumberList& list, const KeyValue& value) {
  const auto* numbers = std::get_if<std::vector<double>>(&value);
  if (numbers == nullptr || numbers->empty() || numbers->size() > list.most) return std::nullopt;
  double last = 0.0;
  for (const double number : *numbers) {
    if (!(number > last && number <= list.high)) return std::nullopt;
    last = number;
  }
  return value;
}

std::string text_of(const PhraseList& list) {
  return fmt::format("a list of 1 ... {} {}, each {}; or \"{}\"", list.most, list.what, list.forms,
                     list.word);
}

std::optional<KeyValue> admitted_by(const PhraseList& list, const KeyValue& value) {
  if (const std::string* word = std::get_if<std::string>(&value))
    return *word == list.word ? std::optional(value) : std::nullopt;
  const auto* phrases = std::get_if<std::vector<std::string>>(&value);
  const bool good = phrases != nullptr && !phrases->empty() && phrases->size() <= list.most &&
                    std::ranges::all_of(*phrases, list.good);
  return good ? std::optional(value) : std::nullopt;
}

}  // namespace

std::string full_name(const KeyHead& key) {
  return key.section.empty() ? key.name : fmt::format("{}.{}", key.section, key.name);
}

const KeyHead* find_key(const KeyHeads& keys, std::string_view wanted) {
  const auto found = std::ranges::find(keys, wanted, [](const KeyHead* key) { return full_name(*key); });
  return found == keys.end() ? nullptr : *found;
}

std::vector<std::string> sections_of(const KeyHeads& keys) {
  std::vector<std::string> names;
  for (const KeyHead* key : keys)
    if (!key->section.empty() && (names.empty() || names.back() != key->section))
      names.push_back(key->section);
  return names;
}

std::string unknown_key(const KeyHeads& keys, const std::string& section, const std::string& name) {
  const std::vector<std::string> sections = sections_of(keys);
  if (!section.empty() && std::ranges::find(sections, section) == sections.end()) {
    const std::string meant = did_you_mean(section, sections);
    return fmt::format(
        "unknown section [{}]{}", visible_word(section),
        meant.empty() ? fmt::format("; expected one of [{}]", joined(sections, "], [")) : meant);
  }
  std::vector<std::string> siblings, elsewhere;
  for (const KeyHead* key : keys) {
    if (key->section == section) siblings.push_back(key->name);
    if (key->name == name) elsewhere.push_back(full_name(*key));
  }
  const auto full = [&section](const std::string& key) {
    return section.empty() ? key : section + "." + key;
  };
  if (const std::string nearest = nearest_word(name, siblings); elsewhere.empty() && !nearest.empty())
    elsewhere = {full(nearest)};
  return fmt::format(
      "unknown key '{}'; {}", visible_word(full(name)),
      !elsewhere.empty() ? fmt::format("did you mean '{}'?", joined(elsewhere, "' or '"))
      : section.empty()
          ? fmt::format("expected {}{}", joined(siblings, ", "),
                        sections.empty() ? "" : fmt::format(", or a section: [{}]", joined(sections, "], [")))
          : fmt::format("[{}] has {}", section, joined(siblings, ", ")));
}

std::string range_text(const KeyHead& key) {
  return std::visit([](const auto& range) { return text_of(range); }, key.range);
}

std::string expectation(const KeyHead& key) {
  return range_text(key) + (key.unit.empty() ? "" : ", in " + key.unit);
}

std::optional<KeyValue> admitted(const KeyHead& key, const KeyValue& value) {
  return std::visit([&value](const auto& range) { return admitted_by(range, value); }, key.range);
}

}  // namespace talus::scenario
