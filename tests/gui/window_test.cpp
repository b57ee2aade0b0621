/// `talus view` as a user meets it: a window on an in-memory display, with mouse and keys.

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <set>
#include <thread>

#include "gui/window_fixture.h"
#include "support/commands.h"

namespace talus::test {
namespace {

class View : public CommandTest {
 protected:
  View() : CommandTest(small_bed) {}
  std::string file(const std::string& name) const { return folder_.text(name); }
};

TEST_F(View, without_a_display_says_so_in_one_line) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  const Outcome outcome = talus({"view", "bed.toml", "-o", "bed.h5"});
  EXPECT_TRUE(ends(outcome, 69, {"DISPLAY"}));
  EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
  EXPECT_FALSE(folder_.has_file("bed.h5.run")) << "no run was begun";
}

TEST_F(View, takes_a_picture_of_itself_without_a_display) {
  unsetenv("DISPLAY");
  const Words command = {"view", "bed.toml", "--screenshot", "view.png", "--size", "640x480"};
  ASSERT_TRUE(ends(talus(command), 0));
  EXPECT_EQ(output_of("od -An -tu1 -j18 -N2 " + folder_.path("view.png") + " | tr -s ' '"), " 2 128")
      << "640 px";
  EXPECT_EQ(talus(command).exit_code, 73) << "it already exists";
  take_run(folder_, "bed.h5", small_bed);
  EXPECT_TRUE(ends(
      talus({"view", "bed.h5", "--screenshot", "two.png", "--second-map", "forces", "--second-minus", "0.5"}),
      0));
}

TEST_F(View, a_picture_of_the_window_replaces_nothing_that_is_shown_in_it) {
  take_run(folder_, "bed.h5", small_bed);
  take_run(folder_, "other.h5", small_bed);
  const std::string run = file("bed.h5"), scenario = file("bed.toml");
  for (const Words& words : {Words{"bed.h5", "--screenshot", "bed.h5"},
                             {"bed.toml", "--screenshot", "bed.toml"},
                             {"bed.toml", "--set", "deposition.method=file", "--set",
                              "deposition.file=other.h5", "--screenshot", "other.h5"}}) {
    EXPECT_TRUE(ends(talus(Words{"view"} + words + Words{"--overwrite"}), 64));
    EXPECT_TRUE(file("bed.h5") == run);
    EXPECT_TRUE(file("other.h5") == run);
    EXPECT_EQ(file("bed.toml"), scenario);
  }
}

TEST_F(View, a_file_that_is_missing_is_said_where_there_is_no_display_too) {
  for (const char* missing : {"nope.h5", "nope.toml"}) {
    const Outcome outcome = talus({"view", missing}, {"DISPLAY=", "WAYLAND_DISPLAY="});
    EXPECT_TRUE(ends(outcome, 66, {missing}));
    EXPECT_FALSE(has(outcome.err, "isplay")) << outcome.err;
  }
}

TEST_F(View, without_a_window_by_a_variable_of_the_environment_says_so) {
  if (const std::string missing = missing_for_desktop(); !missing.empty()) GTEST_SKIP() << missing;
  const Desktop desktop;
  for (const std::string variable : {"MESA_GL_VERSION_OVERRIDE=2.1", "GALLIUM_DRIVER=swr"}) {
    const Outcome outcome = talus({"view", "bed.toml"}, {variable});
    EXPECT_TRUE(ends(outcome, 69, {variable.substr(0, variable.find('='))}));
    EXPECT_FALSE(has(outcome.err, "apt-get")) << outcome.err;
  }
}

TEST_F(View, names_a_display_that_has_no_opengl) {
  if (const std::string missing = missing_for_desktop(); !missing.empty()) GTEST_SKIP() << missing;
  const Desktop desktop(false);
  const Outcome outcome = talus({"view", "bed.toml"});
  EXPECT_TRUE(ends(outcome, 69,
                   {std::string("the display ") + std::getenv("DISPLAY"), "talus view --screenshot",
                    "talus render", "talus export --to html"}));
  EXPECT_FALSE(has(outcome.err, "apt-get")) << outcome.err;
}

TEST_F(View, refuses_a_beginning_or_a_size_that_is_none) {
  std::vector<std::pair<Words, std::string>> cases = {{{"--at", "repose"}, "no frames"},
                                                      {{"--map", "gamm"}, "expected one of"},
                                                      {{"--second-map", "gamm"}, "expected one of"},
                                                      {{"--grain", "100000"}, "0 to"}};
  for (const char* size : {"100", "4cm", "640x", "x480", "640x480x3", "10x10", "99999x500", "a x b"})
    cases.push_back({{"--size", size}, std::string("--size ") + size});
  for (const auto& [words, part] : cases)
    EXPECT_TRUE(ends(talus(Words{"view", "bed.toml", "--screenshot", "view.png"} + words), 64, {part}));
}

/// Counts the colours of a picture.
std::size_t colours_of(const render::Image& image) {
  std::set<std::array<std::uint8_t, 3>> colours;
  for (std::size_t k = 0; k + 2 < image.pixels.size(); k += 3)
    colours.insert({image.pixels[k], image.pixels[k + 1], image.pixels[k + 2]});
  return colours.size();
}

TEST_F(Window, replays_a_run) {
  take_run(folder_, "bed.h5", small_bed);
  start({"bed.h5"});
  EXPECT_TRUE(desktop_->wait_for_title("bed.h5, 0.00° ")) << desktop_->title();
  move_to("map");  // the window under the mouse receives the keys
  desktop_->key("Right");
  EXPECT_TRUE(desktop_->wait_for_title("0.25°")) << desktop_->title();
  const render::Image before = desktop_->screenshot(folder_.path());
  EXPECT_GT(colours_of(before), 50u) << "grains and text with soft edges";
  desktop_->key("End");
  EXPECT_TRUE(desktop_->wait_for_title("1.00°")) << desktop_->title();
  click("back");
  EXPECT_TRUE(desktop_->wait_for_title("0.75°")) << desktop_->title();
  const render::Image after = desktop_->screenshot(folder_.path());
  EXPECT_NE(before.pixels, after.pixels);
  click("first");
  EXPECT_TRUE(desktop_->wait_for_title("0.00°")) << desktop_->title();
  click("play");
  EXPECT_TRUE(desktop_->wait_for_title("1.00°")) << desktop_->title();
  desktop_->key("q");
  EXPECT_EQ(end(), 0);
}

TEST_F(Window, writes_its_curves_as_figures) {
  take_run(folder_, "bed.h5", small_bed);
  start({"bed.h5"});
  click("export plots");
  click("write plots");
  const std::string strain = folder_.path("talus-plots/plot-strain.json"),
                    last = folder_.path("talus-plots/plot-gamma.json");
  for (int wait = 0; wait < 600 && !std::filesystem::exists(last); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ASSERT_TRUE(std::filesystem::exists(strain));
  for (const char* ending : {".pdf", ".csv", ".png"})
    EXPECT_TRUE(std::filesystem::exists(folder_.path("talus-plots/plot-strain") + ending)) << ending;
  desktop_->key("q");
  EXPECT_EQ(end(), 0);
}

TEST_F(Window, lists_its_keys_and_follows_its_size) {
  take_run(folder_, "bed.h5", small_bed);
  start({"bed.h5"});
  move_to("map");
  desktop_->key("question");
  middle_of("help");
  desktop_->resize(640, 400);
  desktop_->key("Escape");
  for (int wait = 0; wait < 100 && middle_of("map").first > 640.0; ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_LT(middle_of("map").first, 640.0);
  EXPECT_LT(middle_of("map").second, 400.0);
  kill(process_, SIGTERM);
  EXPECT_EQ(end(), 75);
}

TEST_F(Window, is_no_larger_than_its_display) {
  process_ = start_talus({"view", "bed.toml", "--size", "1700x1300"}, folder_.path());
  ASSERT_TRUE(desktop_->wait_for_window("– Talus")) << errors_in(folder_.path());
  const std::string geometry = output_of("xdotool getwindowgeometry --shell " + desktop_->window());
  EXPECT_NE(geometry.find("X=0\nY=0\nWIDTH=1500\nHEIGHT=1000"), std::string::npos) << geometry;
}

TEST_F(Window, computes_a_run_and_records_it) {
  start({"bed.toml", "-o", "bed.h5"});
  click("play");
  EXPECT_TRUE(desktop_->wait_for_title("1.00°")) << desktop_->title();
  move_to("map");
  for (int wait = 0; wait < 200 && std::filesystem::exists(folder_.path("bed.h5.run/manifest")) &&
                     !std::filesystem::exists(folder_.path("bed.h5"));
       ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  desktop_->key("q");
  EXPECT_EQ(end(), 0);
  const Outcome info = run_talus({"info", "bed.h5", "--json"}, folder_.path());
  ASSERT_EQ(info.exit_code, 0) << info.err;
  EXPECT_EQ(json_value(info.out, "complete"), "true");
  take_run(folder_, "headless.h5", small_bed);
  const Outcome headless = run_talus({"info", "headless.h5", "--json"}, folder_.path());
  EXPECT_EQ(json_value(info.out, "state_hash"), json_value(headless.out, "state_hash"))
      << "viewing changes nothing";
}

TEST_F(Window, a_recorded_run_that_was_left_can_go_on) {
  start({"bed.toml", "-o", "bed.h5"});
  click("step 10");
  middle_of("map");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  kill(process_, SIGTERM);
  EXPECT_EQ(end(), 75);
  ASSERT_EQ(run_talus({"run", "bed.toml", "-q", "-o", "bed.h5", "--resume"}, folder_.path()).exit_code, 0);
  EXPECT_EQ(json_value(run_talus({"info", "bed.h5", "--json"}, folder_.path()).out, "complete"), "true");
}

TEST_F(Window, a_session_with_commands_replays_headless) {
  start({"bed.toml", "-o", "bed.h5"});
  click("deposit");
  ASSERT_TRUE(wait_until_gone("deposit")) << "the bed is at rest";
  move_to("map");
  desktop_->key("n");
  desktop_->key("u");
  desktop_->key("space");
  EXPECT_TRUE(desktop_->wait_for_title("1.00°")) << desktop_->title();
  desktop_->key("q");
  EXPECT_EQ(end(), 0);
  const Outcome info = run_talus({"info", "bed.h5"}, folder_.path());
  EXPECT_NE(info.out.find("push"), std::string::npos) << info.out;
  EXPECT_TRUE(ends(run_talus({"replay", "bed.h5"}, folder_.path()), 0));
}

TEST_F(View, bad_files_are_said_before_it_opens) {
  write_file(folder_, "bad.toml", "[bed]\nlength = -1\n");
  EXPECT_TRUE(ends(talus({"view", "bad.toml"}), 65, {"bad.toml:2:10"}));
}

}  // namespace
}  // namespace talus::test
