#pragma once
/// Options with few values.

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <string>
#include <vector>

#include "core/nearest_word.h"
#include "core/text.h"
#include "core/visible_text.h"

namespace talus {

/// Accepts these names only; the message has the nearest. Help and completions show them as {a,b}.
inline CLI::Validator one_of(const std::vector<std::string>& names) {
  return {[names](const std::string& word) {
            for (const std::string& name : names)
              if (word == name) return std::string();
            return fmt::format("expected {}, found {}{}", joined(names, " or "), visible_word(word),
                               did_you_mean(word, names));
          },
          fmt::format("{{{}}}", joined(names, ","))};
}

}  // namespace talus
