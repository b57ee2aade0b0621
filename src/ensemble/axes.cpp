#include "ensemble/axes.h"

#include <fmt/core.h>

#include "core/errors.h"
#include "core/visible_text.h"
#include "ensemble/plan.h"
#include "scenario/keys.h"
#include "scenario/text.h"

namespace talus {
namespace {

[[noreturn]] void refuse_axis(const std::string& text) {
  throw Error(
      ExitCode::usage,
      fmt::format("--vary {}: expected KEY=VALUE,VALUE... such as tilt.step=0.002,0.0005; keys that change "
                  "together are joined by colons, as in tilt.rate:tilt.step=2:0.002,0.5:0.0005",
                  visible_word(text)));
}

}  // namespace

std::string key_of_setting(const std::string& setting) { return setting.substr(0, setting.find('=')); }

std::vector<std::string> settings_without(std::vector<std::string> settings,
                                          const std::vector<std::string>& variation) {
  for (const std::string& change : variation)
    std::erase_if(settings, [&](const std::string& setting) {
      return key_of_setting(setting) == key_of_setting(change);
    });
  return settings;
}

std::string variation_name(const std::vector<std::string>& variation, const Scenario& scenario) {
  std::string name;
  for (const std::string& setting : variation) {
    const ScenarioKey* key = find_key(key_of_setting(setting));
    if (!name.empty()) name += ",";
    name += fmt::format("{}={}", full_name(*key), plain_text(key->get(scenario)));
  }
  return name;
}

std::vector<std::vector<std::string>> parse_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) refuse_axis(text);
  const std::vector<std::string> keys = split(text.substr(0, equals), ':');
  std::vector<std::vector<std::string>> variations;
  for (const std::string& item : split(text.substr(equals + 1), ',')) {
    const std::vector<std::string> values = split(item, ':');
    if (values.size() != keys.size()) refuse_axis(text);
    std::vector<std::string> settings;
    for (std::size_t k = 0; k < keys.size(); ++k) {
      if (keys[k].empty() || values[k].empty()) refuse_axis(text);
      settings.push_back(fmt::format("{}={}", keys[k], values[k]));
    }
    variations.push_back(std::move(settings));
  }
  return variations;
}

}  // namespace talus
