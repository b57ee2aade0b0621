#pragma once
/// A key of a table: what a user writes, its unit, range and meaning, and the field of a struct that it sets.
/// Scenarios and the parameters of analyses have one table each; reading, writing, checking, suggestions and
/// the tables of the documents go by them.

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "scenario/text.h"

namespace talus::scenario {

/// A finite number from `low` (included or not) to `high`, or the string `word`, if there is one.
struct NumberRange {
  double low = 0.0;
  double high = 0.0;  ///< infinite: no upper end
  bool low_included = true;
  std::string word;
};

struct IntegerRange {
  std::int64_t low = 0;
  std::int64_t high = 0;
};

/// One of several strings, in the order of the enumerators that they stand for.
struct Choices {
  std::vector<std::string> names;
};

/// true or false.
struct Switch {};

/// Any string without a zero byte, up to a number of bytes; the empty string stands for none.
struct TextRange {
  std::string what;  ///< "the path of a file"
  std::size_t longest = 0;
};

/// From one to `most` ascending numbers in (0, high].
struct NumberList {
  std::size_t most = 0;
  double high = 0.0;
};

/// From one to `most` phrases, each of which is `good`, or the string `word` for none.
struct PhraseList {
  std::string what;  ///< "phrases"
  std::size_t most = 0;
  std::string word;
  std::string forms;  ///< what a phrase may be
  bool (*good)(const std::string& phrase) = nullptr;
  /// The end of a message about one that is not: "; did you mean 'to 12'?", or nothing.
  std::string (*meant)(const std::string& phrase) = nullptr;
};

using KeyRange = std::variant<NumberRange, IntegerRange, Choices, TextRange, NumberList, PhraseList, Switch>;

/// What there is to say of a key, whatever the struct.
struct KeyHead {
  std::string name;
  std::string unit;  ///< empty for a number without one
  KeyRange range;
  std::string help;
  std::string section{};  ///< empty for a key above the first section
};

/// The value of a field: a number, an integer, true or false, text, a list of numbers, an enumerator
/// (Choices), a number that may be missing (the word of its NumberRange), or phrases (without any the word of
/// their PhraseList).
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

/// Sets it to a value that admitted() returned.
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
  /// Sets the field to a value that admitted() returned.
  std::function<void(Struct&, const KeyValue&)> set;

  template <typename T>
  Key(KeyHead head, T Struct::*field)
      : KeyHead(std::move(head)),
        get([field, range = this->range](const Struct& of) { return value_of_field(of.*field, range); }),
        set([field, range = this->range](Struct& of, const KeyValue& value) {
          set_field(of.*field, value, range);
        }) {}

  /// A key of a part, as one of the whole.
  template <typename Part>
  Key(Part Struct::*part, const Key<Part>& key)
      : KeyHead(key),
        get([part, get = key.get](const Struct& of) { return get(of.*part); }),
        set([part, set = key.set](Struct& of, const KeyValue& value) { set(of.*part, value); }) {}
};

/// The keys of a table, in its order. They live as long as it does.
using KeyHeads = std::vector<const KeyHead*>;
template <typename Struct>
KeyHeads heads(const std::vector<Key<Struct>>& keys) {
  KeyHeads all;
  for (const KeyHead& key : keys) all.push_back(&key);
  return all;
}

/// "contact.friction", "seed".
std::string full_name(const KeyHead& key);

/// The key with that full name; nullptr if there is none.
const KeyHead* find_key(const KeyHeads& keys, std::string_view full_name);

/// The sections of a table, in its order; none where its keys have none.
std::vector<std::string> sections_of(const KeyHeads& keys);

/// "a number in [0, 1]", "an integer in 1 ... 100", "\"periodic\" or \"walls\"".
std::string range_text(const KeyHead& key);

/// range_text with the unit, for messages that say what was expected.
std::string expectation(const KeyHead& key);

/// The value as the key holds it (an integer becomes a number if a number is expected); nothing if the
/// value is of another kind or out of range.
std::optional<KeyValue> admitted(const KeyHead& key, const KeyValue& value);

}  // namespace talus::scenario
