/// `talus view`: shows a run in a window, during its computation or from its file.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <fstream>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/map_options.h"
#include "app/options.h"
#include "app/other_programs.h"
#include "app/plot_export.h"
#include "app/program_end.h"
#include "app/run_files.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/output_file.h"
#include "base/text.h"
#include "gui/screen.h"
#include "io/durable_file.h"
#include "io/run_file.h"
#include "pictures/map_plan.h"
#include "render/image.h"
#include "render/layout.h"
#include "render/png.h"
#include "scenario/scenario.h"

namespace talus::app {
namespace {

struct ViewArguments {
  std::string file;
  std::string output;
  std::vector<std::string> settings;  ///< "key=value", including the seed
  bool overwrite = false;
  std::string at;            ///< angle, or "repose"; empty: the first frame
  std::string map;           ///< empty: default of the window
  std::optional<int> grain;  ///< selected grain
  std::string second_map;    ///< map of the second view
  std::string second_minus;  ///< angle of the frame subtracted in the second view
  std::string screenshot;
  std::string context = "auto";
  std::string size = "1400x900";
  double scale = 0.0;  ///< 0: scale of the display
  std::string theme = "light";
  std::string places;
};

constexpr int picture_width = 1600;  ///< px, width of saved maps

/// Returns width and height of the window, px. A size in cm is that on a screen of 96 px per inch; a window
/// without a height has the usual shape.
std::pair<int, int> window_size(const std::string& text) {
  constexpr double px_per_cm = 96.0 / 2.54, shape = 9.0 / 14.0, smallest = 200.0;
  const WrittenSize size = parse_size(text);
  const double unit = size.in_cm ? px_per_cm : 1.0, width = std::round(unit * size.width),
               height = std::round(size.height > 0.0 ? unit * size.height : shape * width);
  const auto possible = [](double side) { return side >= smallest && side <= render::largest_side; };
  if (!possible(width) || !possible(height))
    throw Error(ExitCode::usage, "--size {}: a window of {} x {} px; expected {} to {} px on each side", text,
                width, height, smallest, render::largest_side);
  return {static_cast<int>(width), static_cast<int>(height)};
}

/// Opens the second view, if requested.
void show_second_view(view::ViewModel& model, const ViewArguments& arguments) {
  view::SecondViewState& second_view = model.state.second_view;
  if (!arguments.second_map.empty()) second_view.layers = pictures::map_layers(arguments.second_map);
  if (!arguments.second_minus.empty())
    second_view.minus = model.frame_tilts().at(model.frame_at_angle(arguments.second_minus));
  second_view.shown = second_view.minus || !second_view.layers.empty();
}

/// Applies the options that set the initial display.
void show_first(view::ViewModel& model, const ViewArguments& arguments) {
  if (!arguments.map.empty()) pictures::choose_map(model.state.map, arguments.map, model.own_maps());
  if (!arguments.at.empty()) model.go_to(model.frame_at_angle(arguments.at));
  if (arguments.grain && *arguments.grain >= model.statics().free_count)
    throw Error(ExitCode::usage, "--grain {}: the grains are numbered 0 to {}", *arguments.grain,
                model.statics().free_count - 1);
  model.state.selected = arguments.grain;
  model.state.theme = view::theme_of(arguments.theme);
  model.state.scale = arguments.scale;
  show_second_view(model, arguments);
}

/// Returns the rule for a picture of the window: it must not replace any file shown in the window.
OutputRule output_of_view(const ViewArguments& arguments) {
  OutputRule rule = output_of_run(arguments.file, arguments.overwrite);
  if (io::is_run(arguments.file)) return rule;
  const std::string bed = scenario::read_scenario(arguments.file, arguments.settings).deposition.file;
  if (!bed.empty()) rule.inputs.insert(rule.inputs.end(), {bed, io::run_folder(bed)});
  return rule;
}

/// Draws when background work has finished: nothing new for half a second.
void take_screenshot(const ViewArguments& arguments) {
  using namespace std::chrono_literals;
  const auto [width, height] = window_size(arguments.size);
  const std::optional<render::ContextKind> kind = render::context_kind(arguments.context);
  output_target(arguments.screenshot, output_of_view(arguments));
  view::ViewModel model =
      view::ViewModel::open(arguments.file, arguments.settings, "", false, command_line());
  show_first(model, arguments);
  gui::OffscreenGui gui(model, width, height, 1.0f, kind);
  for (int quiet = 0; quiet < 25; std::this_thread::sleep_for(20ms))
    quiet = model.update(0.0) ? 0 : quiet + 1;
  gui.settle();
  prepare_folder_of(arguments.screenshot);
  render::write_png(arguments.screenshot, gui.frame());
}

/// Returns how to continue a recorded run; empty if it was not recorded.
std::string continuation_text(const view::Recording& run) {
  if (run.output.empty()) return {};
  if (io::run_presence(run.output) == io::RunPresence::packed)
    return fmt::format("{} holds the complete run; view it with: talus view {}", run.output, run.output);
  if (run.scenario.empty())
    return fmt::format("{0} holds the branch so far; continue with: talus run --resume {0}", run.output);
  std::string line = fmt::format("talus run {} -o {}", run.scenario, run.output);
  for (const std::string& setting : run.settings)
    if (!setting.starts_with("seed=")) line += " --set " + setting;
  return fmt::format("{} holds the run so far; continue with: {} --seed {} --resume", run.output, line,
                     run.seed);
}

/// Writes "NAME<tab>X0 Y0 X1 Y1" for each widget, px of the window, for scripts that click; if changed.
void write_places(const std::string& path, const std::vector<gui::WidgetPlace>& places,
                  std::string& written) {
  std::string text;
  for (const gui::WidgetPlace& place : places)
    text +=
        fmt::format("{}\t{:.0f} {:.0f} {:.0f} {:.0f}\n", place.name, place.x0, place.y0, place.x1, place.y1);
  if (text == written) return;
  io::write_text(path, text);
  written = text;
}

/// Closes the run that was shown. Returns a text on its recording.
std::string close(view::ViewModel model) {
  const view::LiveStatus status = model.is_live() ? model.live()->status() : view::LiveStatus{};
  const view::Recording recording = model.recording();
  { const view::ViewModel ended = std::move(model); }  // commits the recorded steps
  if (!status.error.empty()) throw Error(status.error_code, status.error);
  return continuation_text(recording);
}

void save_picture(const std::string& path, gui::GuiWindow& window, view::ViewModel& model) {
  output_target(path, {.overwrite = false});
  render::Image picture = window.screen().draw_image(model.first().furnished_map(), picture_width);
  if (model.state.second_view.shown)
    picture = render::side_by_side(
        {picture, window.screen().draw_image(model.second().furnished_map(), picture_width)});
  render::write_png(path, picture);
  model.state.message = "written: " + path;
}

/// Shows another run; if it cannot be opened, the current one stays.
void open(const std::string& path, std::optional<std::size_t> frame, view::ViewModel& model) {
  if (!model.may_discard()) return;
  model.hold();
  view::ViewModel next = view::ViewModel::open(path, {}, "", false, command_line());
  if (frame) next.go_to(*frame);
  const std::string kept = close(std::exchange(model, std::move(next)));
  if (!kept.empty()) print("{}\n", kept);
  std::fflush(stdout);
}

/// Saves all plots as displayed, or the enlarged one, as figures with their data.
void save_plots(const std::string& folder, view::ViewModel& model) {
  Json plots = Json::array();
  for (const view::Plot& plot : model.plots()) {
    const bool shown = model.state.enlarged_plot.empty() || model.state.enlarged_plot == plot.name;
    const bool empty =
        std::ranges::all_of(plot.series, [](const view::PlotSeries& series) { return series.x.empty(); });
    if (shown && !empty)
      plots.push_back(plot_json(plot, model.state.plot_options[plot.name], model.plot_marks(),
                                model.is_live() ? model.recording().output : model.path()));
  }
  const MemoryFile file("plots");
  std::ofstream(file.path()) << json_text(plots);
  output_of_python_module("figures.plots", {file.path(), folder, command_line()});
  model.state.message = fmt::format("written: {} in {}", counted(plots.size(), "plot"), folder);
}

/// Serves requests of widgets that the model cannot; errors are shown in the window.
void serve_requests(const gui::GuiRequests& requests, gui::GuiWindow& window, view::ViewModel& model) {
  try {
    if (!requests.save_png_path.empty()) save_picture(requests.save_png_path, window, model);
    if (!requests.plots_folder.empty()) save_plots(requests.plots_folder, model);
    if (!requests.open_path.empty()) open(requests.open_path, requests.open_frame, model);
  } catch (const Error& error) {
    model.state.message = error.what();
  }
}

/// Runs until the window is closed, or a signal asks to stop.
void show(view::ViewModel& model, const std::string& places, gui::GuiWindow& window,
          const volatile std::sig_atomic_t* stop) {
  std::string written;
  while (*stop == 0) {
    const gui::GuiRequests requests = window.next_picture(model);
    if (requests.quit) return;
    serve_requests(requests, window, model);
    if (!places.empty()) write_places(places, window.screen().places(), written);
  }
}

/// Returns the rule for a run that the window records, and reports errors even without a display.
OutputRule checked_input(const ViewArguments& arguments) {
  const bool is_missing_run = io::is_run(arguments.file) && !is_there(arguments.file) &&
                              io::run_presence(arguments.file) == io::RunPresence::none;
  if (is_missing_run) throw Error(ExitCode::missing_input, arguments.file + ": no such run");
  if (io::is_run(arguments.file)) return output_of_run(arguments.file, true);
  return output_of_scenario(arguments.file, scenario::read_scenario(arguments.file, arguments.settings));
}

void view(const ViewArguments& arguments) {
  if (!arguments.screenshot.empty()) return take_screenshot(arguments);
  const auto [width, height] = window_size(arguments.size);
  const OutputRule rule = checked_input(arguments);
  gui::GuiWindow window(width, height);  // not shown yet; without a display no run is started
  if (!arguments.output.empty()) output_target(arguments.output, rule);
  view::ViewModel model = view::ViewModel::open(arguments.file, arguments.settings, arguments.output,
                                                arguments.overwrite, command_line());
  const CommitOnSignals commit;
  show_first(model, arguments);
  if (model.is_live() && arguments.output.empty())
    print("This run is not kept until it is saved; talus view {} -o RUN.h5 records it.\n", arguments.file);
  std::fflush(stdout);
  const volatile std::sig_atomic_t* stop = stop_request();
  show(model, arguments.places, window, stop);
  const std::string kept = close(std::move(model));
  if (*stop != 0)
    throw Error(ExitCode::stopped, kept.empty() ? "the window was closed by a signal" : "stopped; " + kept);
  if (!kept.empty()) print("{}\n", kept);
}

}  // namespace

const bool has_window = true;

void add_view_command(CLI::App& app) {
  auto arguments = std::make_shared<ViewArguments>();
  auto seed = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("view", "Show a run in a window: a scenario during its computation, or a run file");
  command->add_option("FILE", arguments->file, "Scenario (SCENARIO.toml) or run (RUN.h5)")->required();
  CLI::Option* output = add_option(*command, "-o,--output", arguments->output, "FILE",
                                   "Record a computed run in this run file [in memory, until it is saved]");
  add_scenario_settings(*command, arguments->settings);
  add_seed_option(*command, *seed);
  command->add_flag("--overwrite", arguments->overwrite,
                    "Replace an existing run or screenshot of this name");
  add_option(*command, "--at", arguments->at, "DEG",
             "Start a replay at this angle in degrees, or at repose, the last frame before failure");
  add_option(*command, "--map", arguments->map, "MAP",
             "Start with this map, or two overlaid as in gamma+forces");
  add_option(*command, "--grain", arguments->grain, "ID", "Select this grain, by number")
      ->check(in_range(0, 1000000000));
  add_option(*command, "--second-map", arguments->second_map, "MAP",
             "Show this map in a second view [map of the first view]");
  add_option(*command, "--second-minus", arguments->second_minus, "DEG",
             "Show in a second view the changes since the frame at this angle, or at repose: grains, and "
             "contacts gained and lost");
  add_option(*command, "--size", arguments->size, "SIZE",
             "Size of the window: 1400x900, or its width alone; in pixels, or in cm as in 36x24cm")
      ->capture_default_str();
  add_option(*command, "--screenshot", arguments->screenshot, "FILE",
             "Write a picture of the window as a PNG file and exit; needs no display")
      ->excludes(output);
  add_option(*command, "--context", arguments->context, "CONTEXT",
             "Rendering context of the screenshot: auto, osmesa or egl")
      ->capture_default_str()
      ->needs("--screenshot");
  command->add_option("--theme", arguments->theme, "Colours of the window; print suits paper")
      ->capture_default_str()
      ->check(one_of({view::theme_names.begin(), view::theme_names.end()}));
  add_option(*command, "--scale", arguments->scale, "FACTOR",
             "Size of text and widgets, 1 on a standard display [that of the display; 1 in a screenshot]")
      ->check(in_range(0.5, 4.0));
  command->add_option("--places", arguments->places, "Write the positions of the widgets to this file")
      ->group("");
  command->callback([arguments, seed] {
    if (!seed->empty()) arguments->settings.push_back(fmt::format("seed={}", *seed));
    view(*arguments);
  });
}

}  // namespace talus::app
