#pragma once
/// Option --seed of commands that compute a run.

#include <CLI/CLI.hpp>
#include <string>

#include "base/visible_text.h"

namespace talus::app {

/// Adds --seed. `seed` receives its digits, for the setting "seed=...", whose range is checked with the
/// scenario; it stays empty if the option is not given.
inline void add_seed_option(CLI::App& command, std::string& seed) {
  command.add_option("--seed", seed, "Seed of the random deposition")->check([](const std::string& text) {
    const bool has_sign = text.starts_with('-') || text.starts_with('+');
    const std::string digits = text.substr(has_sign ? 1 : 0);
    const bool whole = !digits.empty() && digits.find_first_not_of("0123456789") == std::string::npos;
    if (whole) return std::string();
    const bool several = !digits.empty() && digits.find_first_not_of("0123456789-,.: ") == std::string::npos;
    return "expected a whole number, found " + visible_word(text) +
           (several ? "; talus ensemble SCENARIO --seeds 1-3 -o FOLDER computes several beds" : "");
  });
}

}  // namespace talus::app
