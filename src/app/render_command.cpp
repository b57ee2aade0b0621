/// `talus render`: draws maps of a run as PNG, PDF or SVG files.

#include <cstdio>
#include <memory>

#include "app/commands.h"
#include "app/frame_options.h"
#include "app/map_options.h"
#include "app/options.h"
#include "app/program_end.h"
#include "app/progress.h"
#include "app/run_files.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/text.h"
#include "pictures/picture_files.h"

namespace talus::app {
namespace {

struct RenderArguments {
  std::string run;
  MapArguments maps;
  FrameOptions frames;
  std::string format = "png";
  std::string folder;
  bool overwrite = false;
  bool quiet = false;
};

void render(const RenderArguments& arguments) {
  const std::string folder = arguments.folder.empty() ? beside_run(arguments.run, "-maps") : arguments.folder;
  for (const char* ending : {".png", ".pdf", ".svg"})
    if (folder.ends_with(ending))
      throw Error(ExitCode::usage, "{}: expected a folder; talus panel draws into one file of this name",
                  visible_word(folder));
  const CountDone reading = count_shown("reading", arguments.quiet);
  const Watch rendering = {count_shown("rendering", arguments.quiet), asked_to_stop};
  pictures::MapOptions options = map_options(arguments.maps);
  options.document = arguments.format != "png";
  const pictures::MapPlan plan = pictures::plan_maps(options, arguments.run);
  pictures::DrawnRun run = pictures::open_drawn_run(arguments.run, plan, reading);
  FrameOptions frames = arguments.frames;
  if (frames.at.empty() && !frames.every) frames.every = 1.0;
  const pictures::FrameChoice choice = chosen_frames(run.file, arguments.run, frames);
  const std::vector<pictures::PictureFile> files =
      pictures::picture_files(run, choice, folder, arguments.format);
  for (const pictures::PictureFile& file : files)
    output_target(file.path, output_of_run(arguments.run, arguments.overwrite));
  pictures::draw_files(run, files, folder, rendering);
  if (!arguments.quiet) print("{} in {}\n", counted(files.size(), "picture"), folder);
}

}  // namespace

void add_render_command(CLI::App& app) {
  auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command =
      app.add_subcommand("render", "Draw maps of a run as PNG, PDF or SVG files, without a display");
  add_run_argument(*command, arguments->run);
  add_frame_options(*command, arguments->frames, "every degree, and the last before failure");
  add_option(*command, "-o,--output", arguments->folder, "FOLDER",
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
