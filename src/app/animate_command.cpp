/// `talus animate`: a map of a run as a movie.

#include <cstdio>
#include <memory>

#include "app/choices.h"
#include "app/commands.h"
#include "app/map_options.h"
#include "app/output_files.h"
#include "app/progress.h"
#include "app/stop_signals.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "pictures/run_movie.h"

namespace talus::app {
namespace {

struct AnimateArguments {
  std::string run;
  pictures::MapOptions maps;
  pictures::MovieTiming timing;
  std::string output;
  bool overwrite = false;
  bool quiet = false;
};

bool is_movie_name(const std::string& path) {
  return path.ends_with(".mp4") || path.ends_with(".webm") || path.ends_with(".gif");
}

pictures::MapPlan plan_movie(const AnimateArguments& arguments) {
  pictures::MapPlan plan = pictures::plan_maps(arguments.maps);
  if (plan.maps.size() > 1)
    throw Error(ExitCode::usage, "--map: a movie shows one map, or two overlaid as in gamma+forces");
  if (arguments.maps.transparent)
    throw Error(ExitCode::usage,
                "--transparent: a movie has no transparency; talus render draws single pictures with it");
  if (!is_movie_name(arguments.output))
    throw Error(ExitCode::usage, arguments.output + ": expected a name that ends in .mp4, .webm or .gif");
  return plan;
}

void animate(const AnimateArguments& arguments) {
  const pictures::MapPlan plan = plan_movie(arguments);
  output_target(arguments.output, output_of_run(arguments.run, arguments.overwrite));
  pictures::DrawnRun run =
      pictures::open_drawn_run(arguments.run, plan, count_shown("reading", arguments.quiet));
  prepare_folder_of(arguments.output);
  const std::size_t count = pictures::draw_movie(run, arguments.timing, arguments.output,
                                                 {count_shown("animating", arguments.quiet), asked_to_stop});
  if (!arguments.quiet)
    print("%s: %zu frames, %.3g s\n", arguments.output.c_str(), count,
          static_cast<double>(count) / arguments.timing.fps);
}

}  // namespace

void add_animate_command(CLI::App& app) {
  auto arguments = std::make_shared<AnimateArguments>();
  CLI::App* command = app.add_subcommand("animate", "Draw a map of a run as a movie (needs ffmpeg)");
  add_run_argument(*command, arguments->run);
  command
      ->add_option("--every", arguments->timing.every,
                   "Degrees of tilt between frames of the run that are drawn [all frames]")
      ->check(in_range(1e-6, 90.0));
  command->add_option("--fps", arguments->timing.fps, "Frames a second")
      ->capture_default_str()
      ->check(in_range(0.1, 120.0));
  command
      ->add_option(
          "--speed", arguments->timing.speed,
          "Degrees of tilt a second: the time of the movie follows the tilt, and its end is held for "
          "a second [each frame of the run is shown once]")
      ->check(in_range(1e-3, 1000.0));
  command
      ->add_option("-o,--output", arguments->output,
                   "Movie to write: FILE.mp4, FILE.webm or FILE.gif; its folder is made where missing")
      ->required();
  command->add_flag("--overwrite", arguments->overwrite, "Replace an existing file");
  command->add_flag("-q,--quiet", arguments->quiet, "Print errors and warnings only");
  add_map_options(*command, arguments->maps, MapOptionSet::all);
  command->callback([arguments] { animate(*arguments); });
}

}  // namespace talus::app
