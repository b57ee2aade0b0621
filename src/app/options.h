#pragma once
/// Options that several commands share, and validators: one of a few names, or a number in a range.

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <string>
#include <type_traits>
#include <vector>

#include "base/text.h"

namespace talus::app {

/// Accepts these names only; the message suggests the nearest one. Help and completions show them as {a,b}.
CLI::Validator one_of(const std::vector<std::string>& names);

/// Accepts numbers of this type from `low` to `high` inclusive. Help shows them as "(low to high)".
template <typename Number>
CLI::Validator in_range(Number low, Number high) {
  return {[low, high](const std::string& word) {
            Number value{};
            if (CLI::detail::lexical_cast(word, value) && value >= low && value <= high) return std::string();
            return fmt::format("expected a {} from {} to {}, found {}",
                               std::is_integral_v<Number> ? "whole number" : "number", low, high,
                               visible_word(word));
          },
          fmt::format("({} to {})", low, high)};
}

/// Adds an option whose value help shows as `type`: "DEG", "FILE".
template <typename Value>
CLI::Option* add_option(CLI::App& command, const std::string& names, Value& value, const std::string& type,
                        const std::string& text) {
  return command.add_option(names, value, text)->type_name(type);
}

/// Adds the argument RUN.
void add_run_argument(CLI::App& command, std::string& run);

/// Adds --set for keys of a scenario ("Change a key of the scenario", continued by `where`), or for
/// parameters of the analysis. Each --set takes one word, and can be repeated.
CLI::Option* add_scenario_settings(CLI::App& command, std::vector<std::string>& settings,
                                   const std::string& where = "");
CLI::Option* add_analysis_settings(CLI::App& command, std::vector<std::string>& settings,
                                   const std::string& example = "lc_cut=30");

/// Adds --threads; `what` they do: "Threads of the solver".
void add_threads_option(CLI::App& command, int& threads, const std::string& what);

/// Returns the number of processors, the default number of threads and of beds in parallel.
int processor_count();

/// Adds --jobs of a command that computes many beds.
void add_jobs_option(CLI::App& command, int& jobs);

/// Adds --seed. `seed` receives its digits, for the setting "seed=...", whose range is checked with the
/// scenario; it stays empty if the option is not given.
void add_seed_option(CLI::App& command, std::string& seed);

/// Returns the seconds of a wall time "HH:MM" or "HH:MM:SS" as batch systems take it, more than 0. Throws
/// Error(usage), naming `option`.
double parse_wall_time(const std::string& option, const std::string& text);

}  // namespace talus::app
