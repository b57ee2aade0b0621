/// `talus animate`: a map of a run as a movie.

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/count_progress.h"
#include "app/mapped_run.h"
#include "app/movie_frames.h"
#include "app/open_run.h"
#include "app/output_files.h"
#include "core/errors.h"
#include "render/arrange.h"
#include "render/movie.h"
#include "render/renderer.h"

namespace talus {
namespace {

struct AnimateArguments {
  std::string run;
  MapOptions maps;
  MovieTiming timing;
  std::string output;
  bool overwrite = false;
  bool quiet = false;
};

bool is_movie_name(const std::string& path) {
  return path.ends_with(".mp4") || path.ends_with(".webm") || path.ends_with(".gif");
}

MapPlan plan_movie(const AnimateArguments& arguments) {
  MapPlan plan = plan_maps(arguments.maps);
  if (plan.maps.size() > 1)
    throw Error(ExitCode::usage, "--map: a movie shows one map, or two overlaid as in gamma+forces");
  if (arguments.maps.transparent)
    throw Error(ExitCode::usage,
                "--transparent: a movie has no transparency; talus render draws single pictures with it");
  if (!is_movie_name(arguments.output))
    throw Error(ExitCode::usage, arguments.output + ": expected a name that ends in .mp4, .webm or .gif");
  return plan;
}

/// What all frames of a movie have in common.
struct MovieFormat {
  double em = std::numeric_limits<double>::infinity();  ///< font size, px
  int height = 0;                                       ///< px
  bool coloured = false;
};

/// The smallest font size, the largest height, and colour where one of the frames has it: captions and
/// legends of some are longer than those of others.
MovieFormat common_format(MappedRun& run, const std::vector<MovieFrame>& frames, const Font& font) {
  MovieFormat format;
  std::vector<FrameView> views;
  for (const MovieFrame& frame : frames) {
    FrameView& view = views.emplace_back(run.view(frame.frame, 0));
    format.em = std::min(format.em, lay_out(view, run.plan().width, font).em);
    format.coloured = format.coloured || pixel_format(view) == PixelFormat::colour;
    // The layout needs no more of it.
    view.discs = {};
    view.lines = {};
    for (Trace& trace : view.traces) trace.x = trace.y = {};
  }
  for (const FrameView& view : views)
    format.height = std::max(format.height, lay_out(view, run.plan().width, font, format.em).height);
  return format;
}

void make_movie(MappedRun& run, const std::vector<MovieFrame>& frames, const AnimateArguments& arguments,
                const volatile std::sig_atomic_t* stop) {
  const int width = run.plan().width;
  Renderer renderer(make_context(run.plan().context));
  const MovieFormat format = common_format(run, frames, renderer.font());
  Movie movie(arguments.output, width, format.height, format.coloured ? 3 : 1, arguments.timing.fps);
  CountProgress progress("animating", frames.size(), arguments.quiet);
  for (std::size_t k = 0; k < frames.size() && *stop == 0; ++k) {
    FrameView view = run.view(frames[k].frame, 0);
    view.coloured = format.coloured;
    const Image image = padded(renderer.draw(view, width, format.em), format.height);
    for (int shown = 0; shown < frames[k].times && *stop == 0; ++shown) movie.add(image);
    progress.show(k + 1);
  }
  if (*stop == 0) movie.finish();
}

/// One range for all frames, each of which counts once however long it is shown.
void fit_motion(MappedRun& run, const std::vector<MovieFrame>& frames) {
  std::vector<std::size_t> shown;
  for (const MovieFrame& frame : frames)
    if (shown.empty() || shown.back() != frame.frame) shown.push_back(frame.frame);
  run.fit_motion(shown);
}

void animate(const AnimateArguments& arguments) {
  const MapPlan plan = plan_movie(arguments);
  refuse_existing(arguments.output, arguments.overwrite);
  MappedRun run = open_mapped_run(arguments.run, plan, arguments.quiet);
  const std::vector<MovieFrame> frames = movie_frames(clock_tilts(run), arguments.timing);
  fit_motion(run, frames);
  const volatile std::sig_atomic_t* stop = catch_stop_signals();
  try {
    make_movie(run, frames, arguments, stop);
  } catch (const Error&) {
    if (*stop == 0) throw;  // Ctrl-C ends ffmpeg too: that is no error of the movie
  }
  if (*stop != 0)
    throw Error(ExitCode::stopped, "stopped; the movie was not finished, and nothing of it is kept");
  std::size_t count = 0;
  for (const MovieFrame& frame : frames) count += static_cast<std::size_t>(frame.times);
  if (!arguments.quiet)
    std::printf("%s: %zu frames, %.3g s\n", arguments.output.c_str(), count,
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
      ->check(CLI::Range(1e-6, 90.0));
  command->add_option("--fps", arguments->timing.fps, "Frames a second")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 120.0));
  command
      ->add_option(
          "--speed", arguments->timing.speed,
          "Degrees of tilt a second: the time of the movie follows the tilt, and its end is held for "
          "a second [each frame of the run is shown once]")
      ->check(CLI::Range(1e-3, 1000.0));
  command->add_option("-o,--output", arguments->output, "Movie to write: FILE.mp4, FILE.webm or FILE.gif")
      ->required();
  command->add_flag("--overwrite", arguments->overwrite, "Replace a file that exists");
  command->add_flag("-q,--quiet", arguments->quiet, "Print errors and warnings only");
  add_map_options(*command, arguments->maps, MapOptionSet::all);
  command->callback([arguments] { animate(*arguments); });
}

}  // namespace talus
