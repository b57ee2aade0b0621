/// `talus panel`: a bed at several angles in one picture, as in the paper's Figs. 10 and 13.

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>

#include "app/commands.h"
#include "app/mapped_run.h"
#include "app/output_files.h"
#include "app/picture_key.h"
#include "core/errors.h"
#include "maps/frame_choice.h"
#include "render/arrange.h"
#include "render/renderer.h"

namespace talus {
namespace {

struct PanelArguments {
  std::string run;
  MapOptions maps;
  std::vector<std::string> at;
  std::string output;
  bool overwrite = false;
  bool quiet = false;
};

MapPlan plan_panel(const PanelArguments& arguments) {
  MapPlan plan = plan_maps(arguments.maps);
  if (!plan.traces.empty())
    throw Error(ExitCode::usage, "--trace: it marks one angle, and a panel shows several; see talus render");
  if (!arguments.output.ends_with(".png"))
    throw Error(ExitCode::usage, arguments.output + ": expected a name that ends in .png");
  plan.width /= static_cast<int>(plan.maps.size());
  if (plan.width < smallest_width)
    throw Error(ExitCode::usage, "--width " + std::to_string(arguments.maps.width) + ": each of " +
                                     std::to_string(plan.maps.size()) + " maps beside each other takes " +
                                     std::to_string(smallest_width) + " px or more");
  return plan;
}

/// The beds of a panel, row by row: a title stands where it differs from the one above it, legend and scale
/// below the last.
std::vector<std::vector<FrameView>> panel_views(MappedRun& run, const FrameChoice& choice) {
  std::vector<std::vector<FrameView>> rows;
  std::vector<std::string> above(run.plan().maps.size());
  for (std::size_t frame : choice) {
    std::vector<FrameView>& row = rows.emplace_back();
    for (std::size_t map = 0; map < above.size(); ++map) {
      FrameView& view = row.emplace_back(run.view(frame, map));
      if (view.title == above[map])
        view.title.clear();
      else
        above[map] = view.title;
      if (frame == choice.back()) continue;
      view.scale_label.clear();
      view.legends.clear();
    }
  }
  return rows;
}

/// All in one font size and one pixel format.
Image draw_panel(std::vector<std::vector<FrameView>>& rows, const MapPlan& plan) {
  Renderer renderer(make_context(plan.context));
  double em = std::numeric_limits<double>::infinity();
  bool coloured = false;
  for (const std::vector<FrameView>& row : rows)
    for (const FrameView& view : row) {
      em = std::min(em, lay_out(view, plan.width, renderer.font()).em);
      coloured = coloured || pixel_format(view) == PixelFormat::colour;
    }
  std::vector<Image> images;
  for (std::vector<FrameView>& row : rows) {
    std::vector<Image> columns;
    for (FrameView& view : row) {
      view.coloured = coloured;
      columns.push_back(renderer.draw(view, plan.width, em));
    }
    images.push_back(beside(columns));
  }
  return stacked(images);
}

std::string panel_key(const MappedRun& run, const FrameChoice& choice) {
  PictureKey key;
  key.add("panel", std::to_string(run.plan().maps.size()));
  for (std::size_t frame : choice)
    for (std::size_t map = 0; map < run.plan().maps.size(); ++map) key.add("bed", run.key(frame, map));
  return key.text();
}

std::string panel_request(const MappedRun& run, const PanelArguments& arguments) {
  std::string command = "panel";
  for (const std::string& angle : arguments.at) command += " " + angle;
  return picture_request(command, run.path(), run.asked(), run.asked().maps, arguments.output);
}

/// "v_1.h5, frames at 0.000, 15.000 deg, gamma overloaded".
std::string panel_source(const MappedRun& run, const FrameChoice& choice) {
  std::string angles, maps;
  for (std::size_t frame : choice)
    angles += (angles.empty() ? "" : ", ") + tilt_text(run.instants()[frame].tilt);
  for (const MapSettings& map : run.plan().maps) maps += " " + layers_name(map.layers);
  return picture_source(run.path(), "frames at " + angles + " deg," + maps);
}

void make_panel(const PanelArguments& arguments) {
  const MapPlan plan = plan_panel(arguments);
  MappedRun run = open_mapped_run(arguments.run, plan, arguments.quiet);
  const FrameChoice choice = frames_at(run.file().frame_tilts(), arguments.at, run.theta_c());
  run.fit_motion(choice);
  const PictureMarks marks = {panel_key(run, choice), panel_request(run, arguments)};
  const bool drawn = is_drawn(arguments.output, marks, arguments.overwrite);
  if (!drawn) {
    std::vector<std::vector<FrameView>> rows = panel_views(run, choice);
    const Image image = draw_panel(rows, plan);
    write_png(arguments.output, image, picture_texts(marks, panel_source(run, choice)));
  }
  if (!arguments.quiet)
    std::printf("%s: %zu angle%s%s\n", arguments.output.c_str(), choice.size(), choice.size() == 1 ? "" : "s",
                drawn ? ", there before" : "");
}

}  // namespace

void add_panel_command(CLI::App& app) {
  auto arguments = std::make_shared<PanelArguments>();
  CLI::App* command = app.add_subcommand(
      "panel", "Draw a bed at several angles in one picture, a column for each map of --map");
  add_run_argument(*command, arguments->run);
  command
      ->add_option("--at", arguments->at,
                   "Angles in degrees, and repose for the last frame before failure, with commas: "
                   "--at 0,5,10,15,repose")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->required();
  command->add_option("-o,--output", arguments->output, "Picture to write: FILE.png")->required();
  command->add_flag("--overwrite", arguments->overwrite, "Replace a file that exists");
  command->add_flag("-q,--quiet", arguments->quiet, "Print errors and warnings only");
  add_map_options(*command, arguments->maps, MapOptionSet::all);
  command->callback([arguments] { make_panel(*arguments); });
}

}  // namespace talus
