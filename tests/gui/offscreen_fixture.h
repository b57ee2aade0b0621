#pragma once
/// A small run in a window without a display, for tests.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "gui/driven_gui.h"
#include "support/process.h"
#include "support/runs.h"

namespace talus::test {

/// Bed of 40 grains, tilted to 1 deg in five frames.
inline const char* const small_bed =
    "seed = 18\n[bed]\nlength = 10\ndepth = 4\n[tilt]\nstep = 0.01\nend_angle = 1.0\n[output]\nframe_every = "
    "0.25\n";

/// Replay of a small run in a window of 1400 x 900 px.
class Replay : public testing::Test {
 protected:
  Replay() : model_(open_run()), gui_(model_, 1400, 900) {}

  view::ViewModel open_run() {
    return view::ViewModel::open(take_run(folder_, "bed.h5", small_bed), {}, "", false, "");
  }

  /// Returns the position of a grain in the map, as shares of its width and height.
  std::pair<float, float> share_of(Index grain) {
    const gui::WidgetPlace map = gui_.place("map");
    const double aspect = static_cast<double>(map.x1 - map.x0) / static_cast<double>(map.y1 - map.y0);
    const auto [x_min, x_max, y_min, y_max] = model_.first().part(aspect);
    const auto k = static_cast<std::size_t>(grain);
    return {static_cast<float>((model_.frame().x[k] - x_min) / (x_max - x_min)),
            static_cast<float>((y_max - model_.frame().y[k]) / (y_max - y_min))};
  }

  /// Expects everything but the column, which unfolds its inspector at the first selection, to be where it
  /// was.
  void expect_unmoved(const std::vector<gui::WidgetPlace>& before) const {
    const float column = gui_.place("map").x0;
    for (const gui::WidgetPlace& place : before) {
      if (place.x1 < column) continue;
      const gui::WidgetPlace now = gui_.place(place.name);
      EXPECT_TRUE(now.x0 == place.x0 && now.y0 == place.y0 && now.x1 == place.x1 && now.y1 == place.y1)
          << place.name;
    }
  }

  const view::Plot& plot_called(const std::string& name) const {
    return *std::ranges::find(model_.plots(), name, &view::Plot::name);
  }

  TemporaryFolder folder_;
  view::ViewModel model_;
  DrivenGui gui_;
};

/// Returns the names of widgets that have moved; those that have disappeared do not count.
inline std::string moved_since(const std::vector<gui::WidgetPlace>& before, const DrivenGui& gui) {
  std::string moved;
  for (const gui::WidgetPlace& was : before) {
    if (!gui.has(was.name)) continue;
    const gui::WidgetPlace now = gui.place(was.name);
    if (now.x0 != was.x0 || now.y0 != was.y0 || now.x1 != was.x1 || now.y1 != was.y1) moved += " " + was.name;
  }
  return moved;
}

/// Draws until the condition holds; returns false after ten seconds.
inline bool drawn_until(DrivenGui& gui, const std::function<bool()>& so) {
  for (int wait = 0; wait < 1000; ++wait) {
    gui.frame();
    if (so()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// Live run in a window of 1200 x 800 px.
class Live : public testing::Test {
 protected:
  Live() : model_(view::ViewModel::open(scenario(), {}, "", false, "")), gui_(model_, 1200, 800) {}

  std::string scenario() {
    write_file(folder_, "bed.toml", small_bed);
    return folder_.path("bed.toml");
  }

  bool wait_until(const std::function<bool()>& so) { return drawn_until(gui_, so); }
  view::LiveStatus status() { return model_.live()->status(); }

  TemporaryFolder folder_;
  view::ViewModel model_;
  DrivenGui gui_;
};

}  // namespace talus::test
