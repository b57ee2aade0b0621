/// `talus panel`: a bed at several angles in one picture, as in the paper's Figs. 10 and 13.

#include <cstdio>
#include <fmt/core.h>
#include <memory>

#include "app/commands.h"
#include "app/frame_options.h"
#include "app/map_options.h"
#include "app/output_files.h"
#include "app/progress.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "pictures/panel.h"
#include "render/layout.h"

namespace talus::app {
namespace {

struct PanelArguments {
  std::string run;
  pictures::MapOptions maps;
  std::vector<std::string> at;
  std::string output;
  bool overwrite = false;
  bool quiet = false;
};

pictures::MapPlan plan_panel(const PanelArguments& arguments) {
  pictures::MapPlan plan = pictures::plan_maps(arguments.maps);
  if (!plan.traces.empty())
    throw Error(ExitCode::usage, "--trace marks one angle, but a panel shows several; see talus render");
  if (!arguments.output.ends_with(".png"))
    throw Error(ExitCode::usage, arguments.output + ": expected a name that ends in .png");
  plan.width /= static_cast<int>(plan.maps.size());
  for (pictures::MapSettings& map : plan.maps) map.printed /= static_cast<double>(plan.maps.size());
  if (plan.width < render::smallest_width)
    throw Error(ExitCode::usage,
                fmt::format("--width {}: each of {} maps beside each other takes {} px or more",
                            arguments.maps.width, plan.maps.size(), render::smallest_width));
  return plan;
}

void make_panel(const PanelArguments& arguments) {
  const pictures::MapPlan plan = plan_panel(arguments);
  output_target(arguments.output, output_of_run(arguments.run, true));
  pictures::DrawnRun run =
      pictures::open_drawn_run(arguments.run, plan, count_shown("reading", arguments.quiet));
  prepare_folder_of(arguments.output);
  const pictures::PanelDrawn drawn =
      pictures::draw_panel(run, arguments.at, arguments.output, arguments.overwrite);
  if (!arguments.quiet)
    print("%s: %zu angle%s%s\n", arguments.output.c_str(), drawn.angles, drawn.angles == 1 ? "" : "s",
          drawn.there_before ? ", there before" : "");
}

}  // namespace

void add_panel_command(CLI::App& app) {
  auto arguments = std::make_shared<PanelArguments>();
  CLI::App* command = app.add_subcommand(
      "panel", "Draw a bed at several angles in one picture, a column for each map of --map");
  add_run_argument(*command, arguments->run);
  add_at_option(*command, arguments->at)->required();
  command->add_option("-o,--output", arguments->output, "Picture to write: FILE.png")->required();
  command->add_flag("--overwrite", arguments->overwrite, "Replace an existing file");
  command->add_flag("-q,--quiet", arguments->quiet, "Print errors and warnings only");
  add_map_options(*command, arguments->maps, MapOptionSet::all);
  command->callback([arguments] { make_panel(*arguments); });
}

}  // namespace talus::app
