/// `talus render`: maps of a run as PNG files.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/commands.h"
#include "app/map_options.h"
#include "core/errors.h"
#include "maps/frame_choice.h"
#include "render/png.h"
#include "render/renderer.h"

namespace talus {
namespace {

struct RenderArguments {
  MapOptions options;
  std::vector<std::string> maps;
  std::vector<std::string> at;
  double every = 1.0;  ///< deg
  std::string folder;
};

/// RUN-maps for RUN, RUN.h5 and the folder RUN.h5.run, beside the run.
std::string default_folder(std::filesystem::path run) {
  if (!run.has_filename()) run = run.parent_path();  // RUN.h5.run/
  if (run.extension() == ".run") run.replace_extension();
  if (run.extension() == ".h5") run.replace_extension();
  return run.string() + "-maps";
}

FrameChoice choose_frames(const RenderArguments& arguments, const MappedRun& run) {
  const std::vector<double>& tilts = run.file.frame_tilts();
  if (!arguments.at.empty()) return frames_at(tilts, arguments.at, run.theta_c);
  FrameChoice choice = frames_every(tilts, arguments.every);
  if (run.theta_c > 0.0) choice.push_back(frame_at_repose(tilts, run.theta_c));
  std::sort(choice.begin(), choice.end());
  choice.erase(std::unique(choice.begin(), choice.end()), choice.end());
  return choice;
}

void create_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error(ExitCode::cannot_create, folder + ": cannot create the folder: " + error.message());
}

struct Picture {
  std::size_t frame = 0;
  MapKind kind = MapKind::gamma;
  std::string path;
};

std::vector<Picture> plan_pictures(const RenderArguments& arguments, const MappedRun& run,
                                   const std::string& folder) {
  const FrameChoice choice = choose_frames(arguments, run);
  std::vector<Picture> pictures;
  for (const std::string& map : arguments.maps) {
    const std::vector<std::string> names = frame_names(run.file.frame_tilts(), choice, map);
    for (std::size_t k = 0; k < choice.size(); ++k)
      pictures.push_back({choice[k], map_kind(map), (std::filesystem::path(folder) / names[k]).string()});
  }
  return pictures;
}

void render(const RenderArguments& arguments) {
  const MappedRun run = open_mapped_run(arguments.options);
  const std::string folder =
      arguments.folder.empty() ? default_folder(arguments.options.run) : arguments.folder;
  const std::vector<Picture> pictures = plan_pictures(arguments, run, folder);
  for (const Picture& picture : pictures) refuse_existing(picture.path, arguments.options.overwrite);

  Renderer renderer(make_osmesa_context());
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    const FrameView view = map_of_frame(run, pictures[k].frame, pictures[k].kind);
    const Image image = renderer.draw(view, arguments.options.width);
    if (k == 0) create_folder(folder);  // only once there is something to put there
    write_png(pictures[k].path, image);
    show_frame_progress("rendering", k + 1, pictures.size());
  }
  std::printf("%zu picture%s in %s\n", pictures.size(), pictures.size() == 1 ? "" : "s", folder.c_str());
}

}  // namespace

void add_render_command(CLI::App& app) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command = app.add_subcommand("render", "Draw maps of a run as PNG files, without a display");
  add_map_options(*command, arguments->options);
  command
      ->add_option("--map", arguments->maps,
                   "gamma: the stress ratio of each grain, white below 0.05, black above 2 sin(theta_c); "
                   "overloaded: grains with gamma >= sin(theta_c) in black. One, or several with commas")
      ->required()
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"gamma", "overloaded"}));
  CLI::Option* at = command
                        ->add_option("--at", arguments->at,
                                     "Angles in degrees, and repose for the last frame before failure, with "
                                     "commas: --at 0,5,10,15,repose")
                        ->delimiter(',')
                        ->allow_extra_args(false);
  command
      ->add_option("--every", arguments->every,
                   "Degrees between pictures; the last frame before failure is added")
      ->capture_default_str()
      ->check(CLI::Range(1e-6, 90.0))
      ->excludes(at);
  command->add_option("-o,--output", arguments->folder,
                      "Folder of the pictures, made where missing; default RUN-maps");
  command->callback([arguments] { render(*arguments); });
}

}  // namespace talus
