/// `talus render`: draws maps of a run as PNG, PDF or SVG files.

#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/choices.h"
#include "app/commands.h"
#include "app/frame_options.h"
#include "app/map_options.h"
#include "app/output_files.h"
#include "app/progress.h"
#include "app/stop_signals.h"
#include "app/terminal.h"
#include "pictures/picture_files.h"

namespace talus::app {
namespace {

struct RenderArguments {
  std::string run;
  pictures::MapOptions maps;
  FrameOptions frames;
  std::string format = "png";
  std::string folder;
  bool overwrite = false;
  bool quiet = false;
};

/// Returns RUN-maps for RUN, RUN.h5 and the folder RUN.h5.run, next to the run.
std::string default_folder(std::filesystem::path run) {
  if (!run.has_filename()) run = run.parent_path();  // RUN.h5.run/
  if (run.extension() == ".run") run.replace_extension();
  if (run.extension() == ".h5") run.replace_extension();
  return run.string() + "-maps";
}

void render(const RenderArguments& arguments) {
  const std::string folder = arguments.folder.empty() ? default_folder(arguments.run) : arguments.folder;
  const CountDone reading = count_shown("reading", arguments.quiet);
  const Watch rendering = {count_shown("rendering", arguments.quiet), asked_to_stop};
  pictures::MapOptions options = arguments.maps;
  options.document = arguments.format != "png";
  const pictures::MapPlan plan = pictures::plan_maps(options);
  pictures::DrawnRun run = pictures::open_drawn_run(arguments.run, plan, reading);
  FrameOptions frames = arguments.frames;
  if (frames.at.empty() && frames.numbers.empty() && !frames.every) frames.every = 1.0;
  const pictures::FrameChoice choice = chosen_frames(run.file, arguments.run, frames, run.theta_c());
  const std::vector<pictures::PictureFile> files =
      pictures::picture_files(run, choice, folder, arguments.format);
  for (const pictures::PictureFile& file : files)
    output_target(file.path, output_of_run(arguments.run, arguments.overwrite));
  pictures::draw_files(run, files, folder, rendering);
  if (!arguments.quiet)
    print("%zu picture%s in %s\n", files.size(), files.size() == 1 ? "" : "s", folder.c_str());
}

}  // namespace

void add_render_command(CLI::App& app) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command =
      app.add_subcommand("render", "Draw maps of a run as PNG, PDF or SVG files, without a display");
  add_run_argument(*command, arguments->run);
  add_frame_options(*command, arguments->frames, "every degree, and the last before failure");
  command->add_option("-o,--output", arguments->folder,
                      "Folder of the pictures, created if missing [RUN-maps]");
  command->add_option("--format", arguments->format, "png, or pdf or svg for vector graphics")
      ->capture_default_str()
      ->check(one_of({"png", "pdf", "svg"}));
  command->add_flag("--overwrite", arguments->overwrite, "Replace existing pictures");
  command->add_flag("-q,--quiet", arguments->quiet, "Print errors and warnings only");
  add_map_options(*command, arguments->maps, MapOptionSet::all);
  command->callback([arguments] { render(*arguments); });
}

}  // namespace talus::app
