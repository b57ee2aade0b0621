/// `talus animate`: maps of a run as a movie.

#include <cstdio>
#include <fmt/core.h>
#include <memory>

#include "app/commands.h"
#include "app/map_options.h"
#include "app/options.h"
#include "app/program_end.h"
#include "app/progress.h"
#include "app/run_files.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/text.h"
#include "pictures/run_movie.h"
#include "render/layout.h"

namespace talus::app {
namespace {

struct AnimateArguments {
  std::string run;
  MapArguments maps;
  pictures::MovieRequest movie;
  bool overwrite = false;
  bool quiet = false;
};

pictures::MapPlan plan_movie(const AnimateArguments& arguments) {
  const pictures::MapOptions options = map_options(arguments.maps);
  pictures::MapPlan plan = pictures::plan_maps(options, arguments.run);
  if (plan.width / static_cast<int>(plan.maps.size()) < render::smallest_width && plan.height == 0)
    throw Error(ExitCode::usage,
                "a width of {} px is too small: each of {} maps next to each other needs at least {} px",
                plan.width, plan.maps.size(), render::smallest_width);
  if (options.transparent)
    throw Error(ExitCode::usage,
                "--transparent: movies have no transparency; use talus render for pictures with it");
  if (const std::string& name = arguments.movie.output;
      !name.ends_with(".mp4") && !name.ends_with(".webm") && !name.ends_with(".gif"))
    throw Error(ExitCode::usage, name + ": expected a name that ends in .mp4, .webm or .gif");
  return plan;
}

/// Suggests a smaller output.frame_every if each frame of the run is shown several times.
void note_coarse_frames(const pictures::MovieRequest& asked, int times) {
  if (times < 2 || !asked.timing.speed || asked.timing.every > 0.0) return;
  print(
      "each frame of the run is shown up to {} times; output.frame_every = {:.2g} would give a run with one "
      "frame for each frame of the movie\n",
      times, *asked.timing.speed / asked.timing.fps);
}

void animate(AnimateArguments& arguments) {
  pictures::MovieRequest& movie = arguments.movie;
  if (movie.output.empty()) movie.output = beside_run(arguments.run, "-maps.mp4");
  const pictures::MapPlan plan = plan_movie(arguments);
  output_target(movie.output, output_of_run(arguments.run, arguments.overwrite));
  pictures::DrawnRun run =
      pictures::open_drawn_run(arguments.run, plan, count_shown("reading", arguments.quiet));
  prepare_folder_of(movie.output);
  const pictures::MovieResult drawn =
      pictures::draw_movie(run, movie, {count_shown("animating", arguments.quiet), asked_to_stop});
  if (arguments.quiet) return;
  print("{}: {}, {:.3g} s\n", movie.output, counted(drawn.frames, "frame"),
        static_cast<double>(drawn.frames) / movie.timing.fps);
  note_coarse_frames(movie, drawn.max_times);
}

}  // namespace

void add_animate_command(CLI::App& app) {
  auto arguments = std::make_shared<AnimateArguments>();
  CLI::App* command = app.add_subcommand("animate", "Draw maps of a run as a movie (needs ffmpeg)");
  add_run_argument(*command, arguments->run);
  add_option(*command, "--every", arguments->movie.timing.every, "DEG",
             "Degrees of tilt between the frames that are drawn [all frames]")
      ->check(in_range(1e-6, 90.0));
  add_option(*command, "--fps", arguments->movie.timing.fps, "1/S", "Frames per second")
      ->capture_default_str()
      ->check(in_range(0.1, 120.0));
  add_option(*command, "--speed", arguments->movie.timing.speed, "DEG/S",
             "Degrees of tilt per second, so that the movie advances with the tilt [each frame of the run is "
             "shown once]")
      ->check(in_range(1e-3, 1000.0));
  add_option(*command, "--hold", arguments->movie.timing.hold, "S",
             "Seconds for which the first and the last frame are held [with --speed: only the last, for 1 s]")
      ->check(in_range(0.0, 60.0));
  add_option(*command, "-o,--output", arguments->movie.output, "FILE",
             "Movie to write: FILE.mp4, FILE.webm or FILE.gif; a missing folder is created [RUN-maps.mp4]");
  command->add_flag("--overwrite", arguments->overwrite, "Replace an existing file");
  command->add_flag("-q,--quiet", arguments->quiet, "Print errors and warnings only");
  add_map_options(*command, arguments->maps, MapOptionSet::all);
  command->callback([arguments] { animate(*arguments); });
}

}  // namespace talus::app
