/// `talus dump`: the contact problem of a step as a file for solvers.

#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <limits>
#include <memory>

#include "app/commands.h"
#include "app/output_files.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "core/trigonometry.h"
#include "pictures/frame_choice.h"
#include "problems/problem_file.h"

namespace talus::app {
namespace {

struct DumpArguments {
  std::string run;
  std::string output;
  std::size_t frame = 0;
  std::string at;  ///< deg, or "repose"; empty: `frame` counts
  bool overwrite = false;
};

std::size_t choose_frame(const DumpArguments& arguments, const io::RunFile& run) {
  const std::size_t count = run.frame_count();
  if (count == 0)
    throw Error(ExitCode::bad_data,
                arguments.run + " has no frames yet: the first is that of the bed at rest");
  if (!arguments.at.empty()) {
    const double theta_c = find_value(run.checkpoint().results, "theta_c").value_or(std::nan(""));
    if (arguments.at == "repose" && !std::isfinite(theta_c))
      throw Error(ExitCode::bad_data,
                  arguments.run +
                      ": the slope has not failed, so --at repose has no meaning; give an "
                      "angle, or --frame K");
    return pictures::frames_at(run.frame_tilts(), {arguments.at}, theta_c).front();
  }
  if (arguments.frame >= count)
    throw Error(ExitCode::bad_data, fmt::format("{} has {} frames, 0 to {}; there is no frame {}",
                                                arguments.run, count, count - 1, arguments.frame));
  return arguments.frame;
}

std::string step_text(const problems::StepProblem& step, std::int64_t number) {
  return fmt::format("step {} at {:.3f} deg", number, degrees(step.scales.tilt));
}

void dump(const DumpArguments& arguments) {
  output_target(arguments.output, output_of_run(arguments.run, arguments.overwrite));
  const io::RunFile run = io::RunFile::open(arguments.run);
  const std::size_t k = choose_frame(arguments, run);
  const std::int64_t number = run.frame(k).step + 1;
  const problems::StepProblem step = problems::problem_after_frame(run, k);
  const std::string from = step_text(step, number);
  prepare_folder_of(arguments.output);
  problems::write_problem(arguments.output, step,
                          fmt::format("Talus, {} of a run with seed {}", from, run.header().seed));
  print("%s: %s, after frame %zu: %d contacts of %d bodies%s\n", arguments.output.c_str(), from.c_str(), k,
        step.problem.contact_count(), step.problem.body_count(),
        number == run.checkpoint().world.step + 1 ? ", to the last bit" : ", from single precision");
}

}  // namespace

void add_dump_command(CLI::App& app) {
  auto arguments = std::make_shared<DumpArguments>();
  CLI::App* command =
      app.add_subcommand("dump", "Write the contact problem of a step for solvers (FCLIB local problem)");
  command->add_option("RUN", arguments->run, "Run file, or the name of a run that is not complete")
      ->required();
  CLI::Option_group* frame = command->add_option_group("frame", "The step that follows this frame");
  frame->add_option("--frame", arguments->frame, "Frame K, counted from 0");
  frame->add_option("--at", arguments->at,
                    "Nearest frame to an angle in degrees; repose: the last before failure");
  frame->require_option(1);
  command
      ->add_option("-o,--output", arguments->output,
                   "Problem file to write (HDF5; see docs/problem_files.md)")
      ->required();
  command->add_flag("--overwrite", arguments->overwrite, "Replace an existing file");
  command->callback([arguments] { dump(*arguments); });
}

}  // namespace talus::app
