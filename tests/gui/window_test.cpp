/// `talus view` as a user meets it: a window on an in-memory display, with mouse and keys.

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <set>
#include <thread>

#include "gui/window_fixture.h"
#include "support/process.h"

namespace talus::test {
namespace {

TEST(View, without_a_display_says_so_in_one_line) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  const Outcome outcome = run_talus({"view", "bed.toml", "-o", "bed.h5"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 69);
  EXPECT_NE(outcome.err.find("DISPLAY"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("bed.h5.run"))) << "no run was begun";
}

TEST(View, takes_a_picture_of_itself_without_a_display) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  unsetenv("DISPLAY");
  const std::vector<std::string> command = {"view",     "bed.toml", "--screenshot",
                                            "view.png", "--size",   "640x480"};
  const Outcome outcome = run_talus(command, folder.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(output_of("od -An -tu1 -j18 -N2 " + folder.path("view.png") + " | tr -s ' '"), " 2 128")
      << "640 px";
  EXPECT_EQ(run_talus(command, folder.path()).exit_code, 73) << "it already exists";
}

TEST(View, shows_two_views_in_the_picture_and_says_what_cannot_be_beside) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  take_run(folder, "bed.h5", small_bed);
  const auto view = [&](const std::string& file, std::vector<std::string> words) {
    words.insert(words.begin(), {"view", file, "--screenshot", "view.png", "--overwrite"});
    return run_talus(words, folder.path());
  };
  EXPECT_EQ(view("bed.h5", {"--second-map", "forces", "--second-minus", "0.5"}).exit_code, 0);
  EXPECT_EQ(view("bed.h5", {"--second-map", "gamm"}).exit_code, 64);
}

TEST(View, a_picture_of_the_window_replaces_nothing_that_is_shown_in_it) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  take_run(folder, "bed.h5", small_bed);
  std::filesystem::copy_file(folder.path("bed.h5"), folder.path("other.h5"));
  const std::string run = text_of(folder.path("bed.h5")), scenario = text_of(folder.path("bed.toml"));
  const std::vector<std::vector<std::string>> commands = {
      {"bed.h5", "--screenshot", "bed.h5"},
      {"bed.toml", "--screenshot", "bed.toml"},
      {"bed.toml", "--set", "deposition.method=file", "--set", "deposition.file=other.h5", "--screenshot",
       "other.h5"}};
  for (std::vector<std::string> words : commands) {
    words.insert(words.begin(), "view");
    words.emplace_back("--overwrite");
    const Outcome outcome = run_talus(words, folder.path());
    EXPECT_EQ(outcome.exit_code, 64) << outcome.err;
    EXPECT_TRUE(text_of(folder.path("bed.h5")) == run);
    EXPECT_TRUE(text_of(folder.path("other.h5")) == run);
    EXPECT_EQ(text_of(folder.path("bed.toml")), scenario);
  }
}

TEST(View, a_file_that_is_missing_is_said_where_there_is_no_display_too) {
  const TemporaryFolder folder;
  for (const char* file : {"nope.h5", "nope.toml"}) {
    const Outcome outcome = run_talus({"view", file}, folder.path(), {"DISPLAY=", "WAYLAND_DISPLAY="});
    EXPECT_EQ(outcome.exit_code, 66);
    EXPECT_NE(outcome.err.find(file), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("isplay"), std::string::npos) << outcome.err;
  }
}

TEST(View, without_a_window_by_a_variable_of_the_environment_says_so) {
  if (const std::string missing = missing_for_desktop(); !missing.empty()) GTEST_SKIP() << missing;
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  const Desktop desktop;
  for (const std::string variable : {"MESA_GL_VERSION_OVERRIDE=2.1", "GALLIUM_DRIVER=swr"}) {
    const Outcome outcome = run_talus({"view", "bed.toml"}, folder.path(), {variable});
    EXPECT_EQ(outcome.exit_code, 69);
    EXPECT_NE(outcome.err.find(variable.substr(0, variable.find('='))), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("apt-get"), std::string::npos) << outcome.err;
  }
}

TEST(View, names_a_display_that_has_no_opengl) {
  if (const std::string missing = missing_for_desktop(); !missing.empty()) GTEST_SKIP() << missing;
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  const Desktop desktop(false);
  const Outcome outcome = run_talus({"view", "bed.toml"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 69);
  for (const std::string& part :
       {std::string("the display ") + std::getenv("DISPLAY"), std::string("talus view --screenshot"),
        std::string("talus render"), std::string("talus export --to html")})
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("apt-get"), std::string::npos) << outcome.err;
}

TEST(View, refuses_a_beginning_that_is_none) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--at", "repose"}, "no frames"},
      {{"--map", "gamm"}, "expected one of"},
      {{"--grain", "100000"}, "0 to"}};
  for (const auto& [words, part] : cases) {
    std::vector<std::string> command = {"view", "bed.toml", "--screenshot", "view.png"};
    command.insert(command.end(), words.begin(), words.end());
    const Outcome outcome = run_talus(command, folder.path());
    EXPECT_EQ(outcome.exit_code, 64) << words[0];
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  }
}

TEST(View, refuses_sizes_that_are_none) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  for (const char* size : {"640", "640x", "x480", "640x480x3", "10x10", "99999x500", "a x b"}) {
    const Outcome outcome =
        run_talus({"view", "bed.toml", "--screenshot", "view.png", "--size", size}, folder.path());
    EXPECT_EQ(outcome.exit_code, 64) << size;
    EXPECT_NE(outcome.err.find("WIDTHxHEIGHT"), std::string::npos) << outcome.err;
  }
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
                    last = folder_.path("talus-plots/plot-iterations.json");
  for (int wait = 0; wait < 600 && !std::filesystem::exists(last); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  ASSERT_TRUE(std::filesystem::exists(strain));
  for (const char* ending : {".pdf", ".csv", ".svg"})
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
  const Outcome replay = run_talus({"replay", "bed.h5"}, folder_.path());
  EXPECT_EQ(replay.exit_code, 0) << replay.err;
}

TEST_F(Window, bad_files_are_said_before_it_opens) {
  const Outcome missing = run_talus({"view", "none.toml"}, folder_.path());
  EXPECT_EQ(missing.exit_code, 66) << missing.err;
  write_file(folder_, "bad.toml", "[bed]\nlength = -1\n");
  const Outcome bad = run_talus({"view", "bad.toml"}, folder_.path());
  EXPECT_EQ(bad.exit_code, 65) << bad.err;
  EXPECT_NE(bad.err.find("bad.toml:2:10"), std::string::npos) << bad.err;
}

}  // namespace
}  // namespace talus::test
