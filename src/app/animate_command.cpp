/// `talus animate`: maps of a run as a movie.

#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <memory>
#include <optional>
#include <utility>

#include "app/choices.h"
#include "app/commands.h"
#include "app/map_options.h"
#include "app/output_files.h"
#include "app/progress.h"
#include "app/stop_signals.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "pictures/run_movie.h"
#include "render/layout.h"

namespace talus::app {
namespace {

struct AnimateArguments {
  std::string run;
  pictures::MapOptions maps;
  pictures::MovieRequest movie;
  std::string size, aspect;
  bool overwrite = false;
  bool quiet = false;
};

bool is_movie_name(const std::string& path) {
  return path.ends_with(".mp4") || path.ends_with(".webm") || path.ends_with(".gif");
}

/// Returns the two positive numbers of a text such as "1920x1080" or "16:9", separated by `between`.
std::optional<std::pair<double, double>> two_numbers(const std::string& text, char between) {
  const std::size_t middle = text.find(between);
  double first = 0.0, second = 0.0;
  if (middle == std::string::npos || !CLI::detail::lexical_cast(text.substr(0, middle), first) ||
      !CLI::detail::lexical_cast(text.substr(middle + 1), second) || !(first > 0.0) || !(second > 0.0) ||
      !std::isfinite(first * second))
    return std::nullopt;
  return std::pair{first, second};
}

/// Returns width and height in px, from --size or from --width and --aspect.
std::pair<int, int> movie_size(const AnimateArguments& arguments) {
  std::pair<double, double> size{arguments.maps.width, 0.0};
  if (!arguments.size.empty()) {
    const auto found = two_numbers(arguments.size, 'x');
    if (!found || std::round(found->first) != found->first || std::round(found->second) != found->second)
      throw Error(ExitCode::usage,
                  "--size " + arguments.size + ": expected WIDTHxHEIGHT in pixels, e.g. 1920x1080");
    size = *found;
  } else if (!arguments.aspect.empty()) {
    const auto found = two_numbers(arguments.aspect, ':');
    if (!found)
      throw Error(ExitCode::usage, "--aspect " + arguments.aspect + ": expected two numbers, e.g. 16:9");
    size.second = std::round(size.first * found->second / found->first);
  }
  const auto possible = [](double side) {
    return side >= render::smallest_width && side <= render::largest_side;
  };
  if (!possible(size.first) || (size.second != 0.0 && !possible(size.second)))
    throw Error(ExitCode::usage,
                fmt::format("a movie of {} x {} px: expected {} to {} px on each side", size.first,
                            size.second, render::smallest_width, render::largest_side));
  return {static_cast<int>(size.first), static_cast<int>(size.second)};
}

pictures::MapPlan plan_movie(const AnimateArguments& arguments) {
  pictures::MapPlan plan = pictures::plan_maps(arguments.maps);
  plan.width = movie_size(arguments).first;
  if (plan.width / static_cast<int>(plan.maps.size()) < render::smallest_width && arguments.movie.height == 0)
    throw Error(
        ExitCode::usage,
        fmt::format("a width of {} px is too small: each of {} maps next to each other needs at least {} px",
                    plan.width, plan.maps.size(), render::smallest_width));
  if (arguments.maps.transparent)
    throw Error(ExitCode::usage,
                "--transparent: movies have no transparency; use talus render for pictures with it");
  if (!is_movie_name(arguments.movie.output))
    throw Error(ExitCode::usage,
                arguments.movie.output + ": expected a name that ends in .mp4, .webm or .gif");
  return plan;
}

/// Suggests a smaller output.frame_every if each frame of the run is shown several times.
void note_coarse_frames(const pictures::MovieRequest& asked, int times) {
  if (times < 2 || !asked.timing.speed || asked.timing.every > 0.0) return;
  print(
      "each frame of the run is shown up to %d times; output.frame_every = %.2g would give a run with one "
      "frame for each frame of the movie\n",
      times, *asked.timing.speed / asked.timing.fps);
}

void animate(AnimateArguments& arguments) {
  pictures::MovieRequest& movie = arguments.movie;
  movie.height = movie_size(arguments).second;
  const pictures::MapPlan plan = plan_movie(arguments);
  output_target(movie.output, output_of_run(arguments.run, arguments.overwrite));
  pictures::DrawnRun run =
      pictures::open_drawn_run(arguments.run, plan, count_shown("reading", arguments.quiet));
  prepare_folder_of(movie.output);
  const pictures::MovieResult drawn =
      pictures::draw_movie(run, movie, {count_shown("animating", arguments.quiet), asked_to_stop});
  if (arguments.quiet) return;
  print("%s: %zu frames, %.3g s\n", movie.output.c_str(), drawn.frames,
        static_cast<double>(drawn.frames) / movie.timing.fps);
  note_coarse_frames(movie, drawn.max_times);
}

}  // namespace

void add_animate_command(CLI::App& app) {
  auto arguments = std::make_shared<AnimateArguments>();
  CLI::App* command = app.add_subcommand("animate", "Draw maps of a run as a movie (needs ffmpeg)");
  add_run_argument(*command, arguments->run);
  command
      ->add_option("--every", arguments->movie.timing.every,
                   "Degrees of tilt between the frames that are drawn [all frames]")
      ->check(in_range(1e-6, 90.0));
  command->add_option("--fps", arguments->movie.timing.fps, "Frames per second")
      ->capture_default_str()
      ->check(in_range(0.1, 120.0));
  command
      ->add_option("--speed", arguments->movie.timing.speed,
                   "Degrees of tilt per second, so that the movie advances with the tilt [each frame of the "
                   "run is shown once]")
      ->check(in_range(1e-3, 1000.0));
  command
      ->add_option(
          "--hold", arguments->movie.timing.hold,
          "Seconds for which the first and the last frame are held [with --speed: only the last, for 1 s]")
      ->check(in_range(0.0, 60.0));
  CLI::Option* size =
      command->add_option("--size", arguments->size,
                          "Width and height in pixels, e.g. 1920x1080 for a projector; the maps and the "
                          "curves of --trace fill them [from --width and the shape of the bed]");
  command
      ->add_option("--aspect", arguments->aspect,
                   "Aspect ratio, e.g. 16:9; determines the height from --width")
      ->excludes(size);
  command
      ->add_option("-o,--output", arguments->movie.output,
                   "Movie to write: FILE.mp4, FILE.webm or FILE.gif; a missing folder is created")
      ->required();
  command->add_flag("--overwrite", arguments->overwrite, "Replace an existing file");
  command->add_flag("-q,--quiet", arguments->quiet, "Print errors and warnings only");
  add_map_options(*command, arguments->maps, MapOptionSet::all);
  size->excludes(command->get_option("--width"));
  command->callback([arguments] { animate(*arguments); });
}

}  // namespace talus::app
