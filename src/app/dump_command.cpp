/// `talus dump`: writes the contact problem of a step as a file for solvers.

#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <limits>
#include <memory>

#include "app/commands.h"
#include "app/frame_options.h"
#include "app/output_files.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "pictures/frame_choice.h"
#include "problems/problem_file.h"

namespace talus::app {
namespace {

struct DumpArguments {
  std::string run;
  std::string output;
  std::string at;  ///< syntax of frames_at
  bool overwrite = false;
};

std::string step_text(const problems::StepProblem& step, std::int64_t number) {
  return fmt::format("step {} at {} deg", number, degrees_text(step.scales.tilt, 3));
}

void dump(const DumpArguments& arguments) {
  output_target(arguments.output, output_of_run(arguments.run, arguments.overwrite));
  const io::RunFile run = io::RunFile::open(arguments.run);
  const std::size_t k =
      chosen_frames(run, arguments.run, {.numbers = {}, .at = {arguments.at}, .every = {}}).front();
  const std::int64_t number = run.frame(k).step + 1;
  const problems::StepProblem step = problems::problem_after_frame(run, k);
  const std::string from = step_text(step, number);
  prepare_folder_of(arguments.output);
  problems::write_problem(arguments.output, step,
                          fmt::format("Talus, {} of a run with seed {}", from, run.header().seed));
  print("%s: %s, after frame %zu: %d contacts of %d bodies%s\n", arguments.output.c_str(), from.c_str(), k,
        step.problem.contact_count(), step.problem.body_count(),
        number == run.checkpoint().world.step + 1 ? ", bit-identical to the run"
                                                  : ", from a frame in single precision");
}

}  // namespace

void add_dump_command(CLI::App& app) {
  auto arguments = std::make_shared<DumpArguments>();
  CLI::App* command = app.add_subcommand(
      "dump", "Write the contact problem of a step for external solvers (FCLIB local problem)");
  command->add_option("RUN", arguments->run, "Run file, or the name of an incomplete run")->required();
  command
      ->add_option("--at", arguments->at,
                   "Frame that precedes the step: an angle in degrees (nearest frame), repose for the last "
                   "frame before failure, or frame42 by number")
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "Problem file to write (HDF5; see docs/problem_files.md)")
      ->required();
  command->add_flag("--overwrite", arguments->overwrite, "Replace an existing file");
  command->callback([arguments] { dump(*arguments); });
}

}  // namespace talus::app
