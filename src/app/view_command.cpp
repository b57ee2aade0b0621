/// `talus view`: a run in a window, as it is computed or from its file.

#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>
#include <utility>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/open_run.h"
#include "app/output_files.h"
#include "core/errors.h"
#include "gui/offscreen.h"
#include "gui/window.h"
#include "render/output_file.h"
#include "render/png.h"

namespace talus {
namespace {

struct ViewArguments {
  std::string file;
  std::string output;
  std::vector<std::string> settings;  ///< "key=value", the seed among them
  bool overwrite = false;
  std::string screenshot;
  std::string size = "1400x900";
  double scale = 1.0;
  std::string context = "auto";
  std::string places;
};

constexpr int picture_width = 1600;  ///< px, of maps that are saved

/// "1400x900": width and height, px.
std::pair<int, int> parse_size(const std::string& text) {
  int width = 0, height = 0, end = 0;
  const bool read = std::sscanf(text.c_str(), "%5dx%5d%n", &width, &height, &end) == 2;
  if (!read || static_cast<std::size_t>(end) != text.size() || width < 200 || height < 200 || width > 16384 ||
      height > 16384)
    throw Error(ExitCode::usage, "--size " + text + ": expected WIDTHxHEIGHT in pixels, each 200 ... 16384");
  return {width, height};
}

/// Draws once what works in the background has come in: nothing new for half a second.
void take_screenshot(const ViewArguments& arguments) {
  using namespace std::chrono_literals;
  const auto [width, height] = parse_size(arguments.size);
  const std::optional<ContextKind> kind = context_kind(arguments.context);
  refuse_existing(arguments.screenshot, arguments.overwrite);
  ViewModel model = ViewModel::open(arguments.file, arguments.settings, "", false, command_line());
  OffscreenGui gui(model, width, height, static_cast<float>(arguments.scale), kind);
  for (int quiet = 0; quiet < 25; std::this_thread::sleep_for(20ms))
    quiet = model.update(0.0) ? 0 : quiet + 1;
  gui.settle();
  write_png(arguments.screenshot, gui.frame());
}

/// How to go on with a run that was recorded.
std::string way_on(const ViewArguments& arguments, std::uint64_t seed) {
  if (run_presence(arguments.output) == RunPresence::packed)
    return arguments.output + " holds the whole run; look at it again with: talus view " + arguments.output;
  std::string line = "talus run " + arguments.file + " -o " + arguments.output;
  for (const std::string& setting : arguments.settings)
    if (!setting.starts_with("seed=")) line += " --set " + setting;
  return arguments.output + " holds the run so far; continue with: " + line + " --seed " +
         std::to_string(seed) + " --resume";
}

/// "NAME<tab>X0 Y0 X1 Y1" of each widget, px of the window, for scripts that click. Only where it differs
/// from what was written before.
void write_places(const std::string& path, const std::vector<WidgetPlace>& places, std::string& written) {
  std::string text;
  std::array<char, 80> numbers{};
  for (const WidgetPlace& place : places) {
    std::snprintf(numbers.data(), numbers.size(), "\t%.0f %.0f %.0f %.0f\n", place.x0, place.y0, place.x1,
                  place.y1);
    text += place.name + numbers.data();
  }
  if (text == written) return;
  OutputFile file(path);
  file.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  file.commit();
  written = text;
}

/// What the window shows, and where it is recorded.
struct Shown {
  ViewModel model;
  std::string output;  ///< of a live run; empty: nowhere
};

/// Ends what was shown. Returns what there is to say about what was recorded.
std::string close(Shown shown, const ViewArguments& arguments) {
  const std::string failure = shown.model.is_live() ? shown.model.live()->status().error : "";
  const std::uint64_t seed = shown.model.seed();
  { const ViewModel ended = std::move(shown.model); }  // commits what there is
  if (!failure.empty()) throw Error(ExitCode::internal, failure);
  return shown.output.empty() ? "" : way_on(arguments, seed);
}

void save_picture(const std::string& path, GuiWindow& window, ViewModel& model) {
  refuse_existing(path, false);
  write_png(path, window.draw_image(model.furnished_map(), picture_width));
  model.state.message = "written: " + path;
}

/// What widgets ask for beyond the model. What cannot be done is said in the window.
void serve(const GuiRequests& requests, const ViewArguments& arguments, GuiWindow& window, Shown& shown) {
  try {
    if (!requests.save_png_path.empty()) save_picture(requests.save_png_path, window, shown.model);
    if (requests.open_path.empty()) return;
    Shown next{ViewModel::open(requests.open_path, {}, "", false, command_line()), ""};
    const std::string kept = close(std::exchange(shown, std::move(next)), arguments);
    if (!kept.empty()) std::printf("%s\n", kept.c_str());
  } catch (const Error& error) {
    shown.model.state.message = error.what();
  }
}

/// Until the window is closed, or a signal asks to stop.
void show(Shown& shown, const ViewArguments& arguments, GuiWindow& window,
          const volatile std::sig_atomic_t* stop) {
  std::string written;
  while (!window.closed() && *stop == 0) {
    const GuiRequests requests = window.next_picture(shown.model);
    if (requests.quit) return;
    serve(requests, arguments, window, shown);
    if (!arguments.places.empty()) write_places(arguments.places, window.places(), written);
  }
}

void view(const ViewArguments& arguments) {
  if (!arguments.screenshot.empty()) return take_screenshot(arguments);
  const auto [width, height] = parse_size(arguments.size);
  const volatile std::sig_atomic_t* stop = catch_stop_signals();
  GuiWindow window(width, height);  // not shown yet: without a display no run is begun
  Shown shown{ViewModel::open(arguments.file, arguments.settings, arguments.output, arguments.overwrite,
                              command_line()),
              ""};
  if (shown.model.is_live()) shown.output = arguments.output;
  if (shown.model.is_live() && shown.output.empty())
    std::printf("Nothing is kept of this run; talus view %s -o RUN.h5 records it.\n", arguments.file.c_str());
  std::fflush(stdout);
  show(shown, arguments, window, stop);
  const std::string kept = close(std::move(shown), arguments);
  if (*stop != 0) throw Error(ExitCode::stopped, kept.empty() ? "stopped" : "stopped; " + kept);
  if (!kept.empty()) std::printf("%s\n", kept.c_str());
}

}  // namespace

void add_view_command(CLI::App& app) {
  auto arguments = std::make_shared<ViewArguments>();
  auto seed = std::make_shared<std::uint64_t>(0);
  CLI::App* command =
      app.add_subcommand("view", "Look into a run in a window: a scenario as it is computed, or a run file");
  command->add_option("FILE", arguments->file, "Scenario (SCENARIO.toml) or run (RUN.h5)")->required();
  CLI::Option* output = command->add_option("-o,--output", arguments->output,
                                            "Record a run that is computed in this run file [nowhere]");
  command
      ->add_option("--set", arguments->settings,
                   "Change a key of the scenario, e.g. --set contact.friction=0.3")
      ->allow_extra_args(false);
  CLI::Option* seed_option = command->add_option("--seed", *seed, "Seed of the random deposition");
  command->add_flag("--overwrite", arguments->overwrite, "Replace a run, or screenshot, of this name");
  command->add_option("--size", arguments->size, "Width and height of the window, px")->capture_default_str();
  CLI::Option* screenshot =
      command
          ->add_option("--screenshot", arguments->screenshot,
                       "Write a picture of the window as a PNG file and leave: needs no display")
          ->excludes(output);
  command->add_option("--scale", arguments->scale, "Size of text and widgets in the screenshot")
      ->capture_default_str()
      ->check(CLI::Range(0.5, 4.0))
      ->needs(screenshot);
  command->add_option("--context", arguments->context, "What draws the screenshot: auto, osmesa or egl")
      ->capture_default_str()
      ->needs(screenshot);
  command->add_option("--places", arguments->places, "Keep the places of the widgets in this file")
      ->group("");
  command->callback([arguments, seed, seed_option] {
    if (seed_option->count() > 0) arguments->settings.push_back("seed=" + std::to_string(*seed));
    view(*arguments);
  });
}

}  // namespace talus
