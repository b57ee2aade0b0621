#pragma once
/// Opens a view for a test, and waits for its results.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "support/temporary_folder.h"
#include "unit/view/example_bed.h"
#include "view/view_model.h"

namespace talus::example {

/// Opens a view with the gamma of single grains.
inline view::ViewModel opened(const std::string& path) {
  view::ViewModel model = view::ViewModel::open(path, {}, "", false, "talus view");
  model.state.map.l_min = 0.0;
  model.update(0.0);
  return model;
}

/// Updates until the condition holds.
inline bool wait_for_condition(view::ViewModel& model, const std::function<bool()>& holds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!holds() && std::chrono::steady_clock::now() < end) {
    model.update(0.0);
    std::this_thread::yield();
  }
  return holds();
}

/// View of the hand-made run.
class ViewOfBed : public testing::Test {
 protected:
  explicit ViewOfBed(double theta_c = 20.0) {
    write_bed_run(path_, theta_c);
    model_.emplace(opened(path_));
  }
  test::TemporaryFolder folder_;
  const std::string path_ = folder_.path("run.h5");
  std::optional<view::ViewModel> model_;
};

inline const view::Plot& plot(const view::ViewModel& model, const std::string& name) {
  return *std::ranges::find(model.plots(), name, &view::Plot::name);
}

}  // namespace talus::example
