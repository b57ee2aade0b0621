/// `talus render`: maps of a run as PNG files.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/background_tasks.h"
#include "app/commands.h"
#include "app/count_progress.h"
#include "app/map_options.h"
#include "app/mapped_run.h"
#include "app/open_run.h"
#include "app/output_files.h"
#include "app/picture_key.h"
#include "app/picture_names.h"
#include "core/errors.h"
#include "maps/frame_choice.h"
#include "render/png.h"
#include "render/renderer.h"

namespace talus {
namespace {

struct RenderArguments {
  std::string run;
  MapOptions maps;
  std::vector<std::string> at;
  double every = 1.0;  ///< deg
  bool flow = false;
  std::string folder;
  bool overwrite = false;
  bool quiet = false;
};

/// RUN-maps for RUN, RUN.h5 and the folder RUN.h5.run, beside the run.
std::string default_folder(std::filesystem::path run) {
  if (!run.has_filename()) run = run.parent_path();  // RUN.h5.run/
  if (run.extension() == ".run") run.replace_extension();
  if (run.extension() == ".h5") run.replace_extension();
  return run.string() + "-maps";
}

/// Frames of the tilt.
FrameChoice choose_frames(const RenderArguments& arguments, const MappedRun& run) {
  const std::vector<double>& tilts = run.file().frame_tilts();
  if (!arguments.at.empty()) return frames_at(tilts, arguments.at, run.theta_c());
  FrameChoice choice = frames_every(tilts, arguments.every);
  if (std::isfinite(run.theta_c())) choice.push_back(frame_at_repose(tilts, run.theta_c()));
  std::sort(choice.begin(), choice.end());
  choice.erase(std::unique(choice.begin(), choice.end()), choice.end());
  return choice;
}

struct Picture {
  std::size_t frame = 0;
  std::size_t map = 0;  ///< of the plan
  std::string path;
  PictureMarks marks;
};

/// In the order of drawing: all maps of a frame, then the next frame.
std::vector<Picture> plan_pictures(const RenderArguments& arguments, MappedRun& run,
                                   const std::string& folder) {
  FrameChoice choice = choose_frames(arguments, run);
  const std::size_t rising = choice.size();
  if (arguments.flow)
    for (std::size_t k = run.file().frame_count(); k < run.instants().size(); ++k) choice.push_back(k);
  run.fit_motion(choice);
  std::vector<std::vector<std::string>> names;
  for (const MapSettings& map : run.plan().maps)
    names.push_back(picture_names(run, choice, rising, layers_name(map.layers)));
  std::vector<Picture> pictures;
  for (std::size_t k = 0; k < choice.size(); ++k)
    for (std::size_t map = 0; map < names.size(); ++map) {
      const std::string path = (std::filesystem::path(folder) / names[map][k]).string();
      const std::string request =
          picture_request("render", run.path(), run.asked(), {&run.asked().maps[map], 1}, path);
      pictures.push_back({choice[k], map, path, {run.key(choice[k], map), request}});
    }
  return pictures;
}

/// Pictures that may wait to be written: of 16 megapixels in colour each takes 48 MB.
constexpr std::size_t pictures_waiting = 2;

/// While one is encoded and written, the next is drawn.
void draw_pictures(MappedRun& run, const std::vector<Picture>& pictures, const std::string& folder,
                   bool quiet) {
  const volatile std::sig_atomic_t* stop = catch_stop_signals();
  Renderer renderer(make_context(run.plan().context));
  BackgroundTasks writer(pictures_waiting);
  CountProgress progress("rendering", pictures.size(), quiet);
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    const Picture& picture = pictures[k];
    if (*stop != 0) {
      writer.finish();
      throw Error(ExitCode::stopped, "stopped after " + std::to_string(k) + " of " +
                                         std::to_string(pictures.size()) +
                                         " pictures; repeat the command, and those that are there are kept");
    }
    Image image = renderer.draw(run.view(picture.frame, picture.map), run.plan().width);
    if (k == 0) create_folder(folder);  // only once there is something to put there
    const std::string source =
        picture_source(run.path(), run.instants()[picture.frame].tilt, run.plan().maps[picture.map].layers);
    writer.post([path = picture.path, drawn = std::move(image),
                 texts = picture_texts(picture.marks, source)] { write_png(path, drawn, texts); });
    progress.show(k + 1);
  }
  writer.finish();
}

void render(const RenderArguments& arguments) {
  const MapPlan plan = plan_maps(arguments.maps);
  MappedRun run = open_mapped_run(arguments.run, plan, arguments.quiet);
  if (arguments.flow && run.instants().size() == run.file().frame_count())
    throw Error(ExitCode::bad_data, arguments.run +
                                        ": --flow: nothing was followed after failure in this run; "
                                        "tilt.after_failure = \"lower\" or \"hold\" does");
  const std::string folder = arguments.folder.empty() ? default_folder(arguments.run) : arguments.folder;
  std::vector<Picture> pictures = plan_pictures(arguments, run, folder);
  const std::size_t count = pictures.size();
  std::erase_if(pictures, [&](const Picture& picture) {
    return is_drawn(picture.path, picture.marks, arguments.overwrite);
  });
  const std::size_t kept = count - pictures.size();
  if (!pictures.empty()) draw_pictures(run, pictures, folder, arguments.quiet);
  if (arguments.quiet) return;
  std::printf("%zu picture%s in %s", count, count == 1 ? "" : "s", folder.c_str());
  if (kept > 0) std::printf(", %zu of them there before", kept);
  std::printf("\n");
}

}  // namespace

void add_render_command(CLI::App& app) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command = app.add_subcommand("render", "Draw maps of a run as PNG files, without a display");
  add_run_argument(*command, arguments->run);
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
  command->add_flag("--flow", arguments->flow,
                    "Also all frames of the flow after failure, where the run has followed it");
  command->add_option("-o,--output", arguments->folder,
                      "Folder of the pictures, made where missing [RUN-maps]");
  command->add_flag("--overwrite", arguments->overwrite,
                    "Replace pictures of other runs or options; those that are right are kept anyway");
  command->add_flag("-q,--quiet", arguments->quiet, "Print errors and warnings only");
  add_map_options(*command, arguments->maps, MapOptionSet::all);
  command->callback([arguments] { render(*arguments); });
}

}  // namespace talus
