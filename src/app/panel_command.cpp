/// `talus panel`: draws a bed at several angles in one picture, as in the paper's Figs. 10 and 13.

#include <cstdio>
#include <fmt/core.h>
#include <memory>

#include "app/commands.h"
#include "app/frame_options.h"
#include "app/map_options.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/run_files.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/text.h"
#include "pictures/panel.h"
#include "render/document.h"

namespace talus::app {
namespace {

struct PanelArguments {
  std::string run;
  MapArguments maps;
  pictures::PanelRequest panel;
  bool overwrite = false, quiet = false;
};

pictures::MapPlan plan_panel(const PanelArguments& arguments) {
  const std::string& output = arguments.panel.output;
  if (!output.ends_with(".png") && !render::is_document(output))
    throw Error(ExitCode::usage, output + ": expected a name that ends in .png, .pdf or .svg");
  pictures::check_text("--title", arguments.panel.title);
  pictures::MapOptions options = map_options(arguments.maps);
  options.document = render::is_document(output);
  pictures::MapPlan plan = pictures::plan_maps(options, arguments.run);
  if (!plan.traces.empty())
    throw Error(ExitCode::usage, "--trace marks one angle, but a panel shows several; use talus render");
  if (options.bare && !arguments.panel.title.empty())
    throw Error(ExitCode::usage, "--title and --bare exclude each other: a bare bed has no text");
  if (plan.width / static_cast<int>(plan.maps.size()) < render::smallest_width)
    throw Error(ExitCode::usage, "--size {}: each of {} maps next to each other needs at least {} px",
                arguments.maps.size, plan.maps.size(), render::smallest_width);
  return plan;
}

void make_panel(PanelArguments arguments) {
  if (arguments.panel.output.empty()) arguments.panel.output = beside_run(arguments.run, "-panel.png");
  const pictures::MapPlan plan = plan_panel(arguments);
  const std::string& output = arguments.panel.output;
  output_target(output, output_of_run(arguments.run, arguments.overwrite));
  pictures::check_panel(arguments.run, plan, arguments.panel);  // before all frames are read
  pictures::DrawnRun run =
      pictures::open_drawn_run(arguments.run, plan, count_shown("reading", arguments.quiet));
  prepare_folder_of(output);
  const std::size_t angles = pictures::draw_panel(run, arguments.panel);
  if (!arguments.quiet) print("{}: {}\n", output, counted(angles, "angle"));
}

}  // namespace

void add_panel_command(CLI::App& app) {
  auto arguments = std::make_shared<PanelArguments>();
  CLI::App* command = app.add_subcommand(
      "panel", "Draw a bed at several angles in one picture, with a column for each map of --map");
  add_run_argument(*command, arguments->run);
  add_at_option(*command, arguments->panel.at,
                " [the first, the last before failure, and one halfway between them]");
  add_option(*command, "--title", arguments->panel.title, "LINE",
             "Title above all maps; _c sets c as a subscript");
  add_option(*command, "-o,--output", arguments->panel.output, "FILE",
             "Picture to write: FILE.png, or FILE.pdf or FILE.svg for vector graphics [RUN-panel.png]");
  command->add_flag("--overwrite", arguments->overwrite, "Replace an existing file");
  command->add_flag("-q,--quiet", arguments->quiet, "Print errors and warnings only");
  add_map_options(*command, arguments->maps, MapOptionSet::all);
  command->callback([arguments] { make_panel(*arguments); });
}

}  // namespace talus::app
