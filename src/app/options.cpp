#include "app/options.h"

#include <algorithm>
#include <cstdio>
#include <thread>

#include "base/errors.h"
#include "base/text.h"

namespace talus::app {
namespace {

CLI::Option* add_settings(CLI::App& command, std::vector<std::string>& settings, const std::string& text) {
  return add_option(command, "--set", settings, "KEY=VALUE", text)->allow_extra_args(false);
}

}  // namespace

CLI::Validator one_of(const std::vector<std::string>& names) {
  return {[names](const std::string& word) {
            if (std::ranges::find(names, word) != names.end()) return std::string();
            return fmt::format("expected {}, found {}{}", joined(names, " or "), visible_word(word),
                               did_you_mean(word, names));
          },
          fmt::format("{{{}}}", joined(names, ","))};
}

void add_run_argument(CLI::App& command, std::string& run) {
  command.add_option("RUN", run, "Run file RUN.h5, or the folder RUN.h5.run of a run under way")->required();
}

CLI::Option* add_scenario_settings(CLI::App& command, std::vector<std::string>& settings,
                                   const std::string& where) {
  return add_settings(command, settings,
                      fmt::format("Change a key of the scenario{}, e.g. --set contact.friction=0.3", where));
}

CLI::Option* add_analysis_settings(CLI::App& command, std::vector<std::string>& settings,
                                   const std::string& example) {
  return add_settings(
      command, settings,
      fmt::format("Change a parameter of the analysis, e.g. --set {} (see docs/analysis.md)", example));
}

void add_threads_option(CLI::App& command, int& threads, const std::string& what) {
  add_option(command, "--threads", threads, "N", what + "; the result does not depend on it")
      ->capture_default_str()
      ->check(in_range(1, 256));
}

int processor_count() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

void add_jobs_option(CLI::App& command, int& jobs) {
  add_option(
      command, "--jobs", jobs, "N",
      "Number of parallel workers, each on one thread; 0 leaves missing members to talus ensemble work "
      "or submit")
      ->capture_default_str()
      ->check(in_range(0, 256));
}

void add_seed_option(CLI::App& command, std::string& seed) {
  add_option(command, "--seed", seed, "SEED", "Seed of the random deposition")
      ->check([](const std::string& text) {
        const std::size_t sign = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
        const bool whole =
            text.size() > sign && text.find_first_not_of("0123456789", sign) == std::string::npos;
        return whole ? std::string() : "expected a whole number, found " + visible_word(text);
      });
}

double parse_wall_time(const std::string& option, const std::string& text) {
  unsigned hours = 0, minutes = 0, seconds = 0;
  int end = 0;
  bool read = std::sscanf(text.c_str(), "%5u:%2u%n:%2u%n", &hours, &minutes, &end, &seconds, &end) >= 2;
  read = read && static_cast<std::size_t>(end) == text.size() &&
         text.find_first_not_of("0123456789:") == std::string::npos;
  const double time = 3600.0 * hours + 60.0 * minutes + seconds;
  if (!read || minutes > 59 || seconds > 59 || time == 0.0)
    throw Error(ExitCode::usage, "{} {}: expected HH:MM or HH:MM:SS, more than 0, as in {} 23:30", option,
                text, option);
  return time;
}

}  // namespace talus::app
