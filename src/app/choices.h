#pragma once
/// Validators of option values: one of a few names, or a number within a range.

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <string>
#include <type_traits>
#include <vector>

#include "base/nearest_word.h"
#include "base/text.h"
#include "base/visible_text.h"

namespace talus::app {

/// Accepts these names only; the message suggests the nearest one. Help and completions show them as {a,b}.
inline CLI::Validator one_of(const std::vector<std::string>& names) {
  return {[names](const std::string& word) {
            for (const std::string& name : names)
              if (word == name) return std::string();
            return fmt::format("expected {}, found {}{}", joined(names, " or "), visible_word(word),
                               did_you_mean(word, names));
          },
          fmt::format("{{{}}}", joined(names, ","))};
}

/// Accepts numbers of this type from `low` to `high` inclusive. Help shows them as "in [low - high]".
template <typename Number>
CLI::Validator in_range(Number low, Number high) {
  return {[low, high](const std::string& word) {
            Number value{};
            if (CLI::detail::lexical_cast(word, value) && value >= low && value <= high) return std::string();
            return fmt::format("expected a {} from {} to {}, found {}",
                               std::is_integral_v<Number> ? "whole number" : "number", low, high,
                               visible_word(word));
          },
          fmt::format("in [{} - {}]", low, high)};
}

}  // namespace talus::app
