#pragma once
/// "key=value" settings of the command line, interpreted by a table of keys.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenario/key.h"

namespace talus::scenario {

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
