/// Every action has a visible effect in the window, or the line at the bottom says why nothing is done.

#include <gtest/gtest.h>

#include <fmt/core.h>

#include "core/trigonometry.h"
#include "gui/offscreen_fixture.h"

namespace talus {
namespace {

/// State of the window, of its model, and of the requests: enough to detect any effect of an action.
struct GuiOutput {
  render::Image picture;
  gui::GuiRequests requests;
  bool operator==(const GuiOutput& other) const {
    return picture.pixels == other.picture.pixels && requests.quit == other.requests.quit &&
           requests.save_png_path == other.requests.save_png_path &&
           requests.open_path == other.requests.open_path;
  }
};

GuiOutput output_of(test::DrivenGui& gui) { return {gui.frame(), gui.requests()}; }

/// Draws until nothing changes.
void come_to_rest(test::DrivenGui& gui) {
  GuiOutput last = output_of(gui);
  for (int same = 0, tries = 0; same < 3 && tries < 1000; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    GuiOutput next = output_of(gui);
    same = next == last ? same + 1 : 0;
    last = std::move(next);
  }
}

/// Returns all printable characters, and the named keys that the window uses.
std::vector<int> all_keys() {
  std::vector<int> keys = {gui::key_space, gui::key_right, gui::key_left,
                           gui::key_home,  gui::key_end,   gui::key_escape};
  for (int key = gui::key_space + 1; key < 127; ++key) keys.push_back(key);
  return keys;
}

/// Returns the keys listed in the window.
std::vector<int> listed_keys() {
  std::vector<int> keys = {gui::key_space, gui::key_right, gui::key_left,
                           gui::key_home,  gui::key_end,   gui::key_escape};
  for (const char key : std::string("djpc<>123456789 0omv[],.;'t+-=wzaxfnTLiyBPDgbrseukNURMASFGhlC?q"))
    keys.push_back(key);
  return keys;
}

std::string name_of_key(int key) {
  return key > gui::key_space && key < 127 ? std::string(1, static_cast<char>(key))
                                           : fmt::format("key {}", key);
}

/// Run shown in one of the states in which keys are pressed.
struct OpenWindow {
  view::ViewModel model;
  test::DrivenGui gui;
  explicit OpenWindow(view::ViewModel&& opened) : model(std::move(opened)), gui(model, 900, 600) {}
  view::LiveStatus status() { return model.live()->status(); }
  bool runs() { return model.is_live() ? status().running : model.replay()->playing(); }
};

using OpenAgain = std::function<std::unique_ptr<OpenWindow>()>;

/// Presses each key in the same state and expects a visible effect.
void expect_no_silent_key(const OpenAgain& make, const std::vector<int>& keys = listed_keys()) {
  std::unique_ptr<OpenWindow> window;
  view::ViewState begin;
  for (const int key : keys) {
    if (!window) {
      window = make();
      come_to_rest(window->gui);
      window->model.state.message.clear();
      begin = window->model.state;
    }
    view::ViewModel& model = window->model;
    const GuiOutput before = output_of(window->gui);
    const std::string run = model.is_live() ? window->status().state_hash : "replay";
    const std::size_t commands = model.is_live() ? window->status().commands_given : 0;
    const std::size_t frame = model.frame_index();
    window->gui.key(key);
    const bool shown_view = !model.state.message.empty();
    EXPECT_TRUE(shown_view || window->runs() || !(output_of(window->gui) == before))
        << name_of_key(key) << " has no effect and no message";
    const bool same_run = !window->runs() && model.frame_index() == frame && !window->gui.requests().quit &&
                          run == (model.is_live() ? window->status().state_hash : "replay") &&
                          (!model.is_live() || window->status().commands_given == commands);
    if (same_run && !ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup))
      model.state = begin;
    else
      window.reset();
  }
}

class SilentReplay : public testing::Test {
 protected:
  SilentReplay() { test::take_run(folder_, "bed.h5", test::small_bed); }
  OpenAgain at_frame(std::size_t frame) {
    return [this, frame] {
      auto window =
          std::make_unique<OpenWindow>(view::ViewModel::open(folder_.path("bed.h5"), {}, "", false, ""));
      window->model.go_to(frame);
      return window;
    };
  }
  test::TemporaryFolder folder_;
};

TEST_F(SilentReplay, keys_at_the_first_frame) { expect_no_silent_key(at_frame(0), all_keys()); }
TEST_F(SilentReplay, keys_at_the_last_frame) { expect_no_silent_key(at_frame(4)); }

TEST_F(SilentReplay, keys_of_a_branch) {
  expect_no_silent_key([this] {
    auto window = at_frame(2)();
    window->model.branch();
    return window;
  });
}

TEST_F(SilentReplay, a_branch_offers_a_tilt_that_is_still_to_come) {
  const auto window = at_frame(3)();
  window->model.state.run_to_tilt = 0.5;
  window->gui.key('N');
  ASSERT_TRUE(window->model.is_live());
  EXPECT_GT(degrees(window->status().tilt), 0.5);
  EXPECT_EQ(window->model.state.run_to_tilt, 5.0);
}

TEST_F(SilentReplay, the_mouse_says_what_it_cannot_do) {
  const auto window = at_frame(0)();
  test::DrivenGui& gui = window->gui;
  std::string& message = window->model.state.message;
  const auto expect_reported = [&](const char* part) {
    EXPECT_NE(message.find(part), std::string::npos) << part << ": " << message;
    message.clear();
  };
  gui.settle();
  gui.scroll("map", -1.0f);
  expect_reported("The whole bed is visible");
  gui.drag("map", 0.4f, 0.5f, 0.6f, 0.5f);
  expect_reported("The bed ends there");
  gui.click("map", 0.003f, 0.003f);
  expect_reported("No grain is there");
  gui.hold(gui::key_left_shift, true);
  gui.click("map", 0.003f, 0.003f);
  expect_reported("No grain is there");
  gui.drag("map", 0.0f, 0.0f, 1.0f, 1.0f);
  expect_reported("Grains selected: ");
  gui.hold(gui::key_left_shift, false);
  gui.hold(gui::key_left_control, true);
  gui.click("map", 0.003f, 0.003f);
  expect_reported("No contact");
  gui.hold(gui::key_left_control, false);
}

class SilentLive : public testing::Test {
 protected:
  SilentLive() { test::write_file(folder_, "bed.toml", test::small_bed); }
  std::unique_ptr<OpenWindow> begun() {
    return std::make_unique<OpenWindow>(view::ViewModel::open(folder_.path("bed.toml"), {}, "", false, ""));
  }
  std::unique_ptr<OpenWindow> after(const std::function<void(view::LiveRun&)>& play) {
    auto window = begun();
    play(*window->model.live());
    EXPECT_TRUE(test::drawn_until(window->gui, [&] { return !window->runs(); }));
    return window;
  }
  std::unique_ptr<OpenWindow> tilting() {
    return after([](view::LiveRun& run) { run.run_to(radians(0.5)); });
  }
  std::unique_ptr<OpenWindow> ended() {
    return after([](view::LiveRun& run) { run.play(); });
  }
  test::TemporaryFolder folder_;
};

TEST_F(SilentLive, keys_before_the_first_step) {
  expect_no_silent_key([this] { return begun(); });
}
TEST_F(SilentLive, keys_while_it_tilts) {
  expect_no_silent_key([this] { return tilting(); });
}
TEST_F(SilentLive, keys_after_the_end) {
  expect_no_silent_key([this] { return ended(); });
}
TEST_F(SilentLive, keys_of_an_earlier_frame) {
  expect_no_silent_key([this] {
    auto window = tilting();
    window->model.go_to(std::size_t{1});
    return window;
  });
}

TEST_F(SilentLive, no_grain_is_pulled_after_the_end_and_what_is_selected_stays) {
  const auto window = ended();
  view::ViewModel& model = window->model;
  test::DrivenGui& gui = window->gui;
  gui.settle();
  model.select(std::vector<Index>{3, 7, 12});
  const view::ViewCamera camera = model.state.camera;
  const gui::WidgetPlace map = gui.place("map");
  const double width = map.x1 - map.x0, height = map.y1 - map.y0;
  const auto [x_min, x_max, y_min, y_max] = model.first().part(width / height);
  const double x = (model.frame().x[30] - x_min) / (x_max - x_min),
               y = (y_max - model.frame().y[30]) / (y_max - y_min);
  gui.take("map", static_cast<float>(x), static_cast<float>(y));
  for (const float away : {10.0f, 40.0f, 80.0f})
    gui.move(map.x0 + static_cast<float>(x * width) + away, map.y0 + static_cast<float>(y * height) - away);
  EXPECT_TRUE(model.state.selecting.outline.empty());
  gui.release_mouse();
  EXPECT_EQ(model.selected_grains(), (std::vector<Index>{3, 7, 12}));
  EXPECT_EQ(model.state.camera.centre_x, camera.centre_x);
  EXPECT_NE(model.state.message.find("The run has ended: no grain can be pulled"), std::string::npos)
      << model.state.message;
}

TEST_F(SilentLive, a_tilt_that_is_reached_is_offered_no_more_and_a_bed_that_rests_is_not_deposited_again) {
  const auto window = begun();
  view::ViewModel& model = window->model;
  model.state.run_to_tilt = 0.5;
  window->gui.key('g');
  ASSERT_TRUE(test::drawn_until(window->gui, [&] { return !window->runs(); }));
  EXPECT_NEAR(degrees(window->status().tilt), 0.5, 1e-9);
  window->gui.settle();
  EXPECT_EQ(model.state.run_to_tilt, 5.0);
  model.state.run_to_tilt = 0.2;
  window->gui.key('g');
  EXPECT_NE(model.state.message.find("Computing until the tilt is 0.20°"), std::string::npos)
      << model.state.message;
  ASSERT_TRUE(test::drawn_until(window->gui, [&] { return !window->runs(); }));
  EXPECT_NEAR(degrees(window->status().tilt), 0.2, 1e-9) << "the tilt is turned for it";
  window->gui.settle();
  EXPECT_EQ(model.state.run_to_tilt, 0.0) << "the next round angle on its way";
  window->gui.key('b');
  EXPECT_NE(model.state.message.find("The bed is deposited and tilted by 0.20°"), std::string::npos)
      << model.state.message;
}

}  // namespace
}  // namespace talus
