#pragma once
/// talus view on a desktop, for tests.

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <memory>
#include <thread>

#include "gui/desktop.h"
#include "support/process.h"
#include "support/runs.h"

namespace talus::test {

/// Bed of 40 grains, tilted to 1 deg in five frames.
inline const char* const small_bed =
    "seed = 3\n[bed]\nlength = 10\ndepth = 4\n[tilt]\nstep = 0.01\nend_angle = 1.0\n[output]\nframe_every = "
    "0.25\n";

/// talus view on a separate desktop.
class Window : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string missing = missing_for_desktop(); !missing.empty()) GTEST_SKIP() << missing;
    desktop_ = std::make_unique<Desktop>();
    write_file(folder_, "bed.toml", small_bed);
  }
  void TearDown() override {
    if (process_ > 0) {
      kill(process_, SIGKILL);
      wait_for(process_);
    }
  }

  void start(std::vector<std::string> arguments) {
    for (const char* word : {"--places", "places", "--size", "1200x800"}) arguments.emplace_back(word);
    arguments.insert(arguments.begin(), "view");
    process_ = start_talus(arguments, folder_.path());
    ASSERT_TRUE(desktop_->wait_for_window("– Talus")) << errors_in(folder_.path());
  }
  int end() {
    const int code = wait_for(process_);
    process_ = -1;
    return code;
  }

  /// Returns the middle of a widget, px of the window; waits until it exists.
  std::pair<double, double> middle_of(const std::string& name) {
    for (int wait = 0; wait < 200; ++wait) {
      std::ifstream places(folder_.path("places"));
      for (std::string line; std::getline(places, line);) {
        double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;
        if (line.starts_with(name + "\t") &&
            std::sscanf(line.c_str() + name.size(), "%lf %lf %lf %lf", &x0, &y0, &x1, &y1) == 4)
          return {0.5 * (x0 + x1), 0.5 * (y0 + y1)};
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    ADD_FAILURE() << "no widget " << name;
    return {0.0, 0.0};
  }
  /// Waits until a widget has disappeared; returns false after ten seconds.
  bool wait_until_gone(const std::string& name) {
    for (int wait = 0; wait < 200; ++wait) {
      std::ifstream places(folder_.path("places"));
      bool there = false;
      for (std::string line; std::getline(places, line);) there = there || line.starts_with(name + "\t");
      if (!there) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    return false;
  }
  void move_to(const std::string& name) {
    const auto [x, y] = middle_of(name);
    desktop_->move(x, y);
  }
  void click(const std::string& name) {
    move_to(name);
    desktop_->click();
  }

  TemporaryFolder folder_;
  std::unique_ptr<Desktop> desktop_;
  pid_t process_ = -1;
};

}  // namespace talus::test
