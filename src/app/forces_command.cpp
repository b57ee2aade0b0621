/// `talus forces`: quantifies how measured quantities depend on the choice among admissible forces.

#include <fmt/core.h>
#include <memory>

#include "app/commands.h"
#include "app/frame_options.h"
#include "app/options.h"
#include "app/other_programs.h"
#include "base/errors.h"
#include "core/types.h"
#include "io/run_file.h"
#include "pictures/frame_choice.h"
#include "runs/analysis_parameters.h"

namespace talus::app {
namespace {

struct ForcesArguments {
  std::string run;
  std::vector<std::string> at = {"0", "10", "15", "18"};
  std::vector<std::string> settings;
  int solutions = 20;       ///< number of attempts in addition to that from the stored forces
  double tolerance = 3e-7;  ///< residual eta to reach
  int max_iterations = 20000;
  std::uint64_t seed = 1;  ///< seed of the random starts and orders
  bool json = false;
};

pictures::FrameChoice choose_frames(const ForcesArguments& arguments, const io::RunFile& run) {
  if (run.frame_count() == 0)
    throw Error(ExitCode::bad_data,
                arguments.run + " has no frames yet; the first one shows the bed at rest");
  const double theta_c = find_value(run.checkpoint().results, "theta_c").value_or(not_known);
  return pictures::frames_at(run.frame_tilts(), arguments.at, theta_c);
}

/// Checks the options and lets talus.forces search.
void compare(const ForcesArguments& arguments) {
  runs::parse_analysis_settings(arguments.settings);
  std::vector<std::string> words = {
      fmt::format("--solutions={}", arguments.solutions), fmt::format("--tol={}", arguments.tolerance),
      fmt::format("--max-iterations={}", arguments.max_iterations), fmt::format("--seed={}", arguments.seed)};
  for (const std::string& setting : arguments.settings) words.push_back("--set=" + setting);
  if (arguments.json) words.emplace_back("--json");
  words.insert(words.end(), {"--", arguments.run});
  for (const std::size_t k : choose_frames(arguments, io::RunFile::open(arguments.run)))
    words.push_back(std::to_string(k));
  become_python_module("forces", words);
}

void add_search(CLI::App& command, ForcesArguments& search) {
  add_option(command, "--solutions", search.solutions, "N",
             "Number of sets of forces to look for, in addition to the solution from the stored forces")
      ->capture_default_str()
      ->check(in_range(1, 10000));
  add_option(command, "--tol", search.tolerance, "ETA", "Natural-map residual eta that every set must reach")
      ->capture_default_str()
      ->check(in_range(1e-15, 1.0));
  add_option(command, "--max-iterations", search.max_iterations, "N", "Maximum number of iterations")
      ->capture_default_str()
      ->check(in_range(0, 1000000000));
  add_option(command, "--seed", search.seed, "SEED", "Seed of the random starts and orders")
      ->capture_default_str();
}

}  // namespace

void add_forces_command(CLI::App& app) {
  auto arguments = std::make_shared<ForcesArguments>();
  CLI::App* command = app.add_subcommand(
      "forces",
      "Find other admissible forces for the same bed, and compare the quantities measured with them");
  add_run_argument(*command, arguments->run);
  add_at_option(*command, arguments->at)->capture_default_str();
  add_search(*command, *arguments);
  add_analysis_settings(*command, arguments->settings, "l_min=0");
  command->add_flag("--json", arguments->json, "Print a JSON list with one object for each frame");
  command->footer(
      "The grains of each frame are kept in place, and forces that carry them are\nsought from many initial "
      "guesses. A set of forces that does not converge, or\nleaves a grain unsupported, is reported but not "
      "counted.\nThe run file is not changed (see docs/analysis.md).");
  command->callback([arguments] { compare(*arguments); });
}

}  // namespace talus::app
