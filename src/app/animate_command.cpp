/// `talus animate`: a map of a run as a movie.

#include <cstdio>
#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/map_options.h"
#include "maps/frame_choice.h"
#include "render/movie.h"
#include "render/renderer.h"

namespace talus {
namespace {

struct AnimateArguments {
  MapOptions options;
  std::string map;
  double every = 0.0;  ///< deg; 0: all frames
  double fps = 10.0;
  std::string output;
};

void animate(const AnimateArguments& arguments) {
  refuse_existing(arguments.output, arguments.options.overwrite);
  const MappedRun run = open_mapped_run(arguments.options);
  const FrameChoice choice = frames_every(run.file.frame_tilts(), arguments.every);
  const MapKind kind = map_kind(arguments.map);

  Renderer renderer(make_osmesa_context());
  std::optional<Movie> movie;
  for (std::size_t k = 0; k < choice.size(); ++k) {
    const Image image = renderer.draw(map_of_frame(run, choice[k], kind), arguments.options.width);
    if (!movie) movie.emplace(arguments.output, image.width, image.height, arguments.fps);
    movie->add(image);
    show_frame_progress("animating", k + 1, choice.size());
  }
  movie->finish();
  std::printf("%s: %zu frames, %.3g s\n", arguments.output.c_str(), choice.size(),
              static_cast<double>(choice.size()) / arguments.fps);
}

}  // namespace

void add_animate_command(CLI::App& app) {
  auto arguments = std::make_shared<AnimateArguments>();
  CLI::App* command =
      app.add_subcommand("animate", "Draw a map of all frames of a run as a movie (needs ffmpeg)");
  add_map_options(*command, arguments->options);
  command->add_option("--map", arguments->map, "gamma or overloaded; see talus render --help")
      ->required()
      ->check(CLI::IsMember({"gamma", "overloaded"}));
  command
      ->add_option("--every", arguments->every,
                   "Degrees of tilt between frames; default: all frames of the run")
      ->check(CLI::Range(1e-6, 90.0));
  command->add_option("--fps", arguments->fps, "Frames a second")
      ->capture_default_str()
      ->check(CLI::Range(0.1, 120.0));
  command
      ->add_option("-o,--output", arguments->output,
                   "Movie to write: FILE.mp4 (H.264) or FILE.gif (64 grays)")
      ->required();
  command->callback([arguments] { animate(*arguments); });
}

}  // namespace talus
