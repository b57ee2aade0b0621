/// `talus events`: lists the rearrangements of runs in a table.

#include <cstdio>
#include <memory>
#include <optional>

#include "app/choices.h"
#include "app/commands.h"
#include "app/event_report.h"
#include "app/given_runs.h"
#include "app/progress.h"
#include "app/terminal.h"
#include "runs/analysis_parameters.h"

namespace talus::app {
namespace {

struct EventsArguments {
  std::vector<std::string> runs;
  std::vector<std::string> settings;
  runs::AnalysisOptions options;
  std::size_t largest = 0;
  std::optional<double> displacement;  ///< D
  bool json = false, csv = false, quiet = false;
};

std::string text_of(const EventsArguments& arguments, const runs::RunView& run, bool first) {
  if (arguments.json) return (first ? "[" : ",\n") + events_json(run);
  if (arguments.csv) return events_csv(run, first);
  return (first ? "" : "\n") + events_text(run, arguments.largest);
}

MovedGrains moved_grains(const std::string& path, double displacement) {
  const io::RunFile run = io::RunFile::open(path);
  const RunStatics& statics = run.header().statics;
  return {path, statics, displacement, runs::first_moves(run, displacement * statics.mean_diameter)};
}

std::string text_of(const EventsArguments& arguments, const MovedGrains& grains, bool first) {
  if (arguments.json) return (first ? "[" : ",\n") + moves_json(grains);
  if (arguments.csv) return moves_csv(grains, first);
  return (first ? "" : "\n") + moves_text(grains);
}

void list_events(const EventsArguments& arguments) {
  const analysis::AnalysisParameters parameters = runs::parse_analysis_settings(arguments.settings);
  runs::AnalysisOptions options = arguments.options;
  options.progress = count_shown("analysis", arguments.quiet);
  bool first = true;
  for (const std::string& path : with_members(runs_among(arguments.runs))) {
    print_text(arguments.displacement
                   ? text_of(arguments, moved_grains(path, *arguments.displacement), first)
                   : text_of(arguments, runs::analysed_run(path, parameters, options), first));
    std::fflush(stdout);
    first = false;
  }
  if (arguments.json) print("]\n");
}

}  // namespace

void add_events_command(CLI::App& app) {
  auto arguments = std::make_shared<EventsArguments>();
  CLI::App* command = app.add_subcommand("events",
                                         "List the rearrangements of runs before failure with angle, size "
                                         "and place; or the first grains that move");
  command
      ->add_option("RUNS", arguments->runs,
                   "Run files, or folders of ensembles. A missing analysis is computed and stored, as by "
                   "talus analyze")
      ->required();
  auto* largest = command
                      ->add_option("--largest", arguments->largest,
                                   "Number of events of each run, those of largest energy [all]")
                      ->check(in_range<std::size_t>(1, 1000000));
  auto* settings =
      command
          ->add_option(
              "--set", arguments->settings,
              "Change a parameter of the analysis, e.g. --set event_velocity=0.05 (see docs/analysis.md)")
          ->allow_extra_args(false);
  command
      ->add_option("--threads", arguments->options.threads,
                   "Frames analysed in parallel; the result does not depend on it")
      ->capture_default_str()
      ->check(in_range(1, 256));
  auto* force = command->add_flag("--force", arguments->options.force,
                                  "Recompute the analysis even if a valid one is stored");
  command
      ->add_option("--displacement", arguments->displacement,
                   "List, instead of events, the first grains displaced this far, in mean diameters, since "
                   "the tilt began")
      ->check(in_range(1e-6, 1e6))
      ->excludes(largest)
      ->excludes(settings)
      ->excludes(force);
  auto* json = command->add_flag(
      "--json", arguments->json,
      "Print a JSON list with all scalars of each run and its events, in SI units and radians");
  command->add_flag("--csv", arguments->csv, "Print CSV, one table of all runs, in SI units and radians")
      ->excludes(json)
      ->excludes(largest);
  json->excludes(largest);
  command->add_flag("-q,--quiet", arguments->quiet, "Show no progress");
  command->footer(
      "Energy: work of gravity on the grains. Grains, depth, x, y: number, depth and\ncentre of the grains "
      "that moved between the frames around the event.\ndV/V, dy/y: change of the volume and of the height "
      "of the centre of mass,\npositive if the bed dilates; dz: change of the coordination "
      "number.\ndocs/analysis.md defines all of them. --displacement: in the frame of the bed,\nfrom the "
      "frames of the run; x, y and depth below the mean surface refer to the\nfirst frame in which the grain "
      "has moved.");
  command->callback([arguments] { list_events(*arguments); });
}

}  // namespace talus::app
