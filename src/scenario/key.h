#pragma once
/// A key of a table: its name, unit, range and meaning, and the member of a struct that it sets. Scenarios
/// and the parameters of analyses have one table each, on which reading, writing, checking, suggestions and
/// the tables in the documentation are based.

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "scenario/text.h"

namespace talus::scenario {

/// A finite number from `low` (included or not) to `high`, or the string `word` unless it is empty.
struct NumberRange {
  double low = 0.0;
  double high = 0.0;  ///< infinite for no upper limit
  bool low_included = true;
  std::string word;
};

/// Return the range from `low` (included, excluded) to `high`, or the word.
inline NumberRange from_to(double low, double high, std::string word = {}) {
  return {low, high, true, std::move(word)};
}
inline NumberRange above_to(double low, double high, std::string word = {}) {
  return {low, high, false, std::move(word)};
}

/// An integer from `low` to `high`, both included.
struct IntegerRange {
  std::int64_t low = 0;
  std::int64_t high = 0;
};

/// One of several strings, in the order of the corresponding enumerators.
struct Choices {
  std::vector<std::string> names;
};

/// A boolean, true or false.
struct Switch {};

/// A string without zero bytes, of limited length in bytes; the empty string means no value.
struct TextRange {
  std::string what;  ///< "the path of a file"
  std::size_t longest = 0;
};

/// A list of 1 to `most` ascending numbers in (0, high].
struct NumberList {
  std::size_t most = 0;
  double high = 0.0;
};

/// A list of 1 to `most` phrases that are accepted by `good`, or the string `word` for none.
struct PhraseList {
  std::string what;  ///< "phrases"
  std::size_t most = 0;
  std::string word;
  std::string forms;  ///< description of the accepted phrases
  bool (*good)(const std::string& phrase) = nullptr;
  std::string (*meant)(const std::string& phrase) = nullptr;  ///< end of a message about one that is not
};

/// The accepted values of a key.
using KeyRange = std::variant<NumberRange, IntegerRange, Choices, TextRange, NumberList, PhraseList, Switch>;

/// The part of a key that does not depend on the struct.
struct KeyHead {
  std::string name;
  std::string unit;  ///< empty for a number without one
  KeyRange range;
  std::string help;
  std::string section{};  ///< empty for a key above the first section
};

/// Returns the value of a field: a number, an integer, a boolean, text, a list of numbers, an enumerator
/// (Choices), an optional number (without one, the word of its NumberRange), or phrases (without any, the
/// word of their PhraseList).
template <typename T>
KeyValue value_of_field(const T& field, const KeyRange& range) {
  if constexpr (std::is_enum_v<T>)
    return std::get<Choices>(range).names.at(static_cast<std::size_t>(field));
  else if constexpr (std::is_same_v<T, std::optional<double>>)
    return field ? KeyValue(*field) : std::get<NumberRange>(range).word;
  else if constexpr (std::is_same_v<T, std::vector<std::string>>)
    return field.empty() ? KeyValue(std::get<PhraseList>(range).word) : KeyValue(field);
  else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>)
    return static_cast<std::int64_t>(field);
  else
    return field;
}

/// Sets a field to a value returned by admitted().
template <typename T>
void set_field(T& field, const KeyValue& value, const KeyRange& range) {
  if constexpr (std::is_enum_v<T>) {
    const auto& names = std::get<Choices>(range).names;
    field = static_cast<T>(std::ranges::find(names, std::get<std::string>(value)) - names.begin());
  } else if constexpr (std::is_same_v<T, std::optional<double>>) {
    const double* number = std::get_if<double>(&value);
    field = number != nullptr ? std::optional(*number) : std::nullopt;
  } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
    const T* phrases = std::get_if<T>(&value);
    field = phrases != nullptr ? *phrases : T();
  } else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
    field = static_cast<T>(std::get<std::int64_t>(value));
  } else {
    field = std::get<T>(value);
  }
}

/// A key of one struct.
template <typename Struct>
struct Key : KeyHead {
  std::function<KeyValue(const Struct&)> get;
  /// Sets the field to a value returned by admitted().
  std::function<void(Struct&, const KeyValue&)> set;

  template <typename T>
  Key(KeyHead head, T Struct::*field)
      : KeyHead(std::move(head)),
        get([field, range = this->range](const Struct& owner) {
          return value_of_field(owner.*field, range);
        }),
        set([field, range = this->range](Struct& owner, const KeyValue& value) {
          set_field(owner.*field, value, range);
        }) {}

  /// Creates a key of the whole struct from a key of a part.
  template <typename Part>
  Key(Part Struct::*part, const Key<Part>& key)
      : KeyHead(key),
        get([part, get = key.get](const Struct& owner) { return get(owner.*part); }),
        set([part, set = key.set](Struct& owner, const KeyValue& value) { set(owner.*part, value); }) {}
};

/// The keys of a table, in its order. The pointers are valid as long as the table exists.
using KeyHeads = std::vector<const KeyHead*>;
/// Returns the keys of a table.
template <typename Struct>
KeyHeads heads(const std::vector<Key<Struct>>& keys) {
  KeyHeads all;
  for (const KeyHead& key : keys) all.push_back(&key);
  return all;
}

/// Returns the full name of a key: "contact.friction", "seed".
std::string full_name(const KeyHead& key);

/// Returns the key with this full name; nullptr if there is none.
const KeyHead* find_key(const KeyHeads& keys, std::string_view full_name);

/// Returns the sections of a table, in its order; empty if its keys have none.
std::vector<std::string> sections_of(const KeyHeads& keys);

/// Returns a message about an unknown key `name` of `section` (empty above the first one): with the keys of
/// that name in other sections, otherwise with the nearest key of the section or with all of them. If there
/// is no such section, the message is about the section.
std::string unknown_key(const KeyHeads& keys, const std::string& section, const std::string& name);

/// Describes the range of a key: "a number in [0, 1]", "an integer in 1 ... 100", "\"periodic\" or
/// \"walls\"".
std::string range_text(const KeyHead& key);

/// Describes the range and unit of a key, for messages about the expected value.
std::string expectation(const KeyHead& key);

/// Returns the value as stored in the key (an integer becomes a number if a number is expected); empty if the
/// value has another type or is out of range.
std::optional<KeyValue> admitted(const KeyHead& key, const KeyValue& value);

/// Returns the values of `--set key=value` settings. `example` is a setting for messages: "lc_cut=30". Throws
/// LocatedError(bad_data) with a line for each setting that is not accepted: `--set lc_cut=-3: error: key
/// 'lc_cut' = -3: expected a number in (0, 10000] or "depth", in D`.
std::map<const KeyHead*, KeyValue> read_settings(const KeyHeads& keys,
                                                 const std::vector<std::string>& settings,
                                                 const std::string& example);

/// Returns a struct with these values and its defaults for the other keys. Throws as read_settings does.
template <typename Struct>
Struct parse_settings(const std::vector<Key<Struct>>& keys, const std::vector<std::string>& settings,
                      const std::string& example) {
  const auto values = read_settings(heads(keys), settings, example);
  Struct result;
  for (const Key<Struct>& key : keys)
    if (const auto value = values.find(&key); value != values.end()) key.set(result, value->second);
  return result;
}

}  // namespace talus::scenario
