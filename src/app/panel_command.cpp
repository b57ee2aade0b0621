/// `talus panel`: draws a bed at several angles in one picture, as in the paper's Figs. 10 and 13.

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
#include "base/visible_text.h"
#include "pictures/panel.h"
#include "render/document.h"

namespace talus::app {
namespace {

struct PanelArguments {
  std::string run;
  pictures::MapOptions maps;
  pictures::PanelRequest panel;
  bool overwrite = false, quiet = false;
};

pictures::MapPlan plan_panel(const PanelArguments& arguments) {
  const std::string& output = arguments.panel.output;
  if (!output.ends_with(".png") && !render::is_document(output))
    throw Error(ExitCode::usage, output + ": expected a name that ends in .png, .pdf or .svg");
  if (!render::can_be_set(render::embedded_font(), arguments.panel.title))
    throw Error(ExitCode::usage, fmt::format("--title {}: pictures support only Latin-1 letters (in UTF-8), "
                                             "some Greek letters and common signs",
                                             visible_word(arguments.panel.title)));
  pictures::MapOptions options = arguments.maps;
  options.document = render::is_document(output);
  pictures::MapPlan plan = pictures::plan_maps(options);
  if (!plan.traces.empty())
    throw Error(ExitCode::usage, "--trace marks one angle, but a panel shows several; use talus render");
  if (arguments.maps.bare && !arguments.panel.title.empty())
    throw Error(ExitCode::usage, "--title and --bare exclude each other: a bare bed has no text");
  if (plan.width / static_cast<int>(plan.maps.size()) < render::smallest_width)
    throw Error(ExitCode::usage,
                fmt::format("--width {}: each of {} maps next to each other needs at least {} px",
                            arguments.maps.width, plan.maps.size(), render::smallest_width));
  return plan;
}

void make_panel(const PanelArguments& arguments) {
  const pictures::MapPlan plan = plan_panel(arguments);
  const std::string& output = arguments.panel.output;
  output_target(output, output_of_run(arguments.run, arguments.overwrite));
  pictures::DrawnRun run =
      pictures::open_drawn_run(arguments.run, plan, count_shown("reading", arguments.quiet));
  prepare_folder_of(output);
  const std::size_t angles = pictures::draw_panel(run, arguments.panel);
  if (!arguments.quiet) print("%s: %zu angle%s\n", output.c_str(), angles, angles == 1 ? "" : "s");
}

}  // namespace

void add_panel_command(CLI::App& app) {
  auto arguments = std::make_shared<PanelArguments>();
  CLI::App* command = app.add_subcommand(
      "panel", "Draw a bed at several angles in one picture, with a column for each map of --map");
  add_run_argument(*command, arguments->run);
  add_at_option(*command, arguments->panel.at)->required();
  command->add_option("--title", arguments->panel.title, "Title above all maps; _c sets c as a subscript");
  command
      ->add_option("-o,--output", arguments->panel.output,
                   "Picture to write: FILE.png, or FILE.pdf or FILE.svg for vector graphics")
      ->required();
  command->add_flag("--overwrite", arguments->overwrite, "Replace an existing file");
  command->add_flag("-q,--quiet", arguments->quiet, "Print errors and warnings only");
  add_map_options(*command, arguments->maps, MapOptionSet::all);
  command->callback([arguments] { make_panel(*arguments); });
}

}  // namespace talus::app
