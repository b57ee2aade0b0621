/// The window of `talus view`, drawn in memory. For a scenario that is computed at the same time: pictures
/// per second, at most 30, and their cost to the solver. For a run file: the time from the request of another
/// frame to its picture. Prints a row of a Markdown table for each display.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include "base/errors.h"
#include "gui/screen.h"
#include "program.h"

namespace talus::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double seconds_shown = 10.0;
constexpr double picture_interval = 1.0 / 30.0;  // s
constexpr int width = 1400, height = 900;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Prints the beginning of a row.
void print_times(const char* what, std::vector<double> pictures, double elapsed) {
  std::ranges::sort(pictures);
  const auto ms = [&pictures](double share) {
    return 1e3 * pictures[static_cast<std::size_t>(share * static_cast<double>(pictures.size() - 1))];
  };
  std::printf("| %s | %.1f | %.1f | %.1f | %.1f |", what, static_cast<double>(pictures.size()) / elapsed,
              ms(0.5), ms(0.95), ms(1.0));
}

/// Draws and reads back at most 30 pictures a second for a while as the run continues.
void draw_frames(const char* what, view::ViewModel& model, gui::OffscreenGui& gui) {
  const std::int64_t first = model.live()->status().step;
  std::vector<double> pictures;
  const auto start = Clock::now();
  while (seconds_since(start) < seconds_shown) {
    const auto begin = Clock::now();
    (void)gui.frame();
    pictures.push_back(seconds_since(begin));
    std::this_thread::sleep_for(std::chrono::duration<double>(picture_interval - pictures.back()));
  }
  const double elapsed = seconds_since(start);
  print_times(what, std::move(pictures), elapsed);
  std::printf(" %.0f |\n", static_cast<double>(model.live()->status().step - first) / elapsed);
}

/// Measures the displays, from the cheapest to the most expensive.
template <typename Draw>
void draw_all(view::ViewModel& model, const Draw& draw) {
  draw("gamma, all plots");
  model.state.selected = model.statics().free_count / 2;
  draw("the same, a grain selected");
  model.state.map.layers = {pictures::MapKind::clusters, pictures::MapKind::forces};
  draw("clusters and forces, a grain selected");
}

/// Draws and reads back all frames of a run as fast as possible.
void replay(const char* what, view::ViewModel& model, gui::OffscreenGui& gui) {
  std::vector<double> pictures;
  const auto start = Clock::now();
  for (std::size_t k = 0; k < model.frame_count(); ++k) {
    const auto begin = Clock::now();
    model.go_to(k);
    (void)gui.frame();
    pictures.push_back(seconds_since(begin));
  }
  print_times(what, pictures, seconds_since(start));
  std::printf("\n");
}

void measure_replay(view::ViewModel& model) {
  std::printf("Replay: window of %d x %d px, %zu frames of %d grains.\n\n", width, height,
              model.frame_count(), model.statics().free_count);
  std::printf("| display | pictures/s | ms each, median | 95 %% | longest |\n|---|--:|--:|--:|--:|\n");
  gui::OffscreenGui gui(model, width, height);
  draw_all(model, [&](const char* what) { replay(what, model, gui); });
}

void measure_live(view::ViewModel& model) {
  model.live()->finish_deposition();
  while (model.live()->status().depositing || model.live()->status().running)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  model.update(0.0);
  std::printf("Live: window of %d x %d px, %d grains; the solver has one thread.\n\n", width, height,
              model.statics().free_count);
  std::printf(
      "| display | pictures/s | ms each, median | 95 %% | longest | steps/s "
      "|\n|---|--:|--:|--:|--:|--:|\n");
  model.live()->play();
  const auto start = Clock::now();
  const std::int64_t first = model.live()->status().step;
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds_shown));
  std::printf("| no drawing | | | | | %.0f |\n",
              static_cast<double>(model.live()->status().step - first) / seconds_since(start));
  gui::OffscreenGui gui(model, width, height);
  draw_all(model, [&](const char* what) { draw_frames(what, model, gui); });
}

int run(int argc, char** argv) {
  if (argc != 2) throw Error(ExitCode::usage, "usage: view_bench SCENARIO.toml or RUN.h5");
  view::ViewModel model = view::ViewModel::open(argv[1], {}, "", false, "view_bench");
  if (model.is_live())
    measure_live(model);
  else
    measure_replay(model);
  return 0;
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) {
  return talus::bench::run_program("view_bench", talus::bench::run, argc, argv);
}
