/// Maps drawn from a run file: file names, kept files, rejected requests, interruptions, movies, panels.

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <thread>

#include "pictures.h"
#include "support/places.h"
#include "support/process.h"
#include "support/runs.h"

namespace talus::test {
namespace {

namespace fs = std::filesystem;

/// Bed of 40 grains with frames at 0, 0.5, 1 and 1.5 deg.
const char* const tiny_bed =
    "seed = 3\n[bed]\nlength = 10\ndepth = 4\n[tilt]\nstep = 0.01\nend_angle = 1.5\n[output]\nframe_every = "
    "0.5\n";

using Words = std::vector<std::string>;

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

class MapCommands : public testing::Test {
 protected:
  Outcome talus(const Words& arguments) { return run_talus(arguments, folder_.path()); }
  void make_run() {
    write_file(folder_, "bed.toml", tiny_bed);
    take_run(folder_, "bed.h5", tiny_bed);
  }
  /// The bed remains stable, so its theta_c is unknown.
  Outcome render(const Words& more) { return talus(Words{"render", "bed.h5", "--theta-c", "20"} + more); }
  std::set<std::string> files(const char* name) { return names_in(folder_.path() / name); }

  TemporaryFolder folder_;
};

TEST_F(MapCommands, refuse_what_makes_no_sense_before_they_look_for_the_run) {
  const std::vector<std::pair<Words, std::string>> cases = {
      {{"--map", "gamm"}, "gamma"},
      {{"--map", "gamma+forces+critical"}, "two"},
      {{"--map", "gamma,gamma"}, "twice"},
      {{}, "--map"},
      {{"--map", "gamma", "--colours", "rainbow"}, "its lightness rises and falls"},
      {{"--map", "gamma", "--colours", "turbo"}, "expected one of gray, viridis, cividis, magma"},
      {{"--map", "gamma", "--colours", "contrast"}, "only to the map clusters"},
      {{"--map", "overloaded", "--colours", "viridis"}, "has a bar"},
      {{"--map", "gamma", "--trace", "energy"}, "largest_cluster"},
      {{"--map", "gamma", "--context", "vulkan"}, "osmesa"},
      {{"--map", "overloaded", "--range", "0,1"}, "no bar"},
      {{"--map", "gamma,pressure", "--range", "0,1"}, "one map at a time"},
      {{"--map", "gamma", "--range", "1,1"}, "LOW < HIGH"},
      {{"--map", "gamma", "--crop", "5,0,5,2"}, "empty"},
      {{"--map", "gamma", "--length", "5"}, "coarse"},
      {{"--map", "gamma", "--since", "1"}, "displacement"},
      {{"--map", "gamma", "--joined", "neighbours"}, "clusters"},
      {{"--map", "clusters", "--joined", "glue"}, "neighbours"},
      {{"--map", "pressure", "--threshold", "2"}, "Gamma_c"},
      {{"--map", "coarse", "--l-min", "0"}, "gamma of grains"},
      {{"--map", "gamma", "--l-min", "-1"}, "--l-min"},
      {{"--map", "gamma", "--bare", "--trace", "overloaded"}, "--bare"},
      {{"--map", "gamma", "--bare", "--for", "slide"}, "--bare"},
      {{"--map", "gamma", "--for", "slides"}, "did you mean 'slide'?"},
      {{"--map", "gamma", "--format", "eps"}, "svg"},
      {{"--map", "gamma", "--printed", "1"}, "--printed"},
      {{"--map", "gamma", "--width", "1000000"}, "--width"},
      {{"--map", "gamma", "--width", "20"}, "--width"},
  };
  for (const auto& [arguments, part] : cases) {
    const Outcome outcome = talus(Words{"render", "none.h5"} + arguments);
    EXPECT_EQ(outcome.exit_code, 64) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << ": " << outcome.err;
  }
  const std::vector<std::pair<Words, std::string>> others = {
      {{"animate", "none.h5", "--map", "gamma", "-o", "x.mp4", "--transparent"}, "transparen"},
      {{"animate", "none.h5", "--map", "gamma,forces", "-o", "x.mp4", "--width", "300"}, "2 maps"},
      {{"animate", "none.h5", "--map", "gamma", "-o", "x.mp4", "--size", "1920"}, "WIDTHxHEIGHT"},
      {{"animate", "none.h5", "--map", "gamma", "-o", "x.mp4", "--size", "640.5x480"}, "WIDTHxHEIGHT"},
      {{"animate", "none.h5", "--map", "gamma", "-o", "x.mp4", "--size", "640x480", "--width", "400"},
       "--width"},
      {{"render", "none.h5", "--map", "gamma", "--colours", "gray,viridis"}, "one for clusters"},
      {{"panel", "none.h5", "--map", "gamma", "--at", "0", "-o", "x.png", "--title", "a", "--bare"},
       "--title"},
      {{"animate", "none.h5", "--map", "gamma", "-o", "x.mp4", "--size", "1920x-1080"}, "WIDTHxHEIGHT"},
      {{"animate", "none.h5", "--map", "gamma", "-o", "x.mp4", "--size", "1920x100"}, "on each side"},
      {{"animate", "none.h5", "--map", "gamma", "-o", "x.mp4", "--aspect", "16/9"}, "16:9"},
      {{"animate", "none.h5", "--map", "gamma", "-o", "x.mp4", "--aspect", "16:9", "--size", "300x300"},
       "--aspect"},
      {{"animate", "none.h5", "--map", "gamma", "-o", "x.avi"}, ".webm"},
      {{"panel", "none.h5", "--map", "gamma", "--at", "0", "-o", "x.png", "--trace", "overloaded"},
       "--trace"},
      {{"panel", "none.h5", "--map", "gamma,overloaded,forces", "--at", "0", "-o", "x.png", "--width", "500"},
       "--width 500"},
      {{"panel", "none.h5", "--map", "gamma", "--at", "0", "-o", "x.jpg"}, ".svg"},
      {{"panel", "none.h5", "--map", "gamma", "--at", "0", "-o", "x.png", "--title", "日本"}, "Latin-1"},
      {{"panel", "none.h5", "--map", "gamma", "--at", "0", "-o", "x.png", "--title", "a\nb"}, "Latin-1"},
      {{"run", "none.toml", "--map", "gamma"}, "--pictures"},
      {{"run", "none.toml", "--pictures", "maps"}, "--map"},
      {{"run", "none.toml", "--pictures", "maps", "--map", "gamm"}, "gamma"},
  };
  for (const auto& [arguments, part] : others) {
    const Outcome outcome = talus(arguments);
    EXPECT_EQ(outcome.exit_code, 64) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << ": " << outcome.err;
  }
}

TEST_F(MapCommands, refuse_what_the_run_does_not_have) {
  make_run();
  const std::vector<std::tuple<Words, int, std::string>> cases = {
      {{"render", "bed.h5", "--map", "gamma"}, 65, "--theta-c"},
      {{"render", "bed.h5", "--map", "pressure", "--trace", "overloaded"}, 65, "--theta-c"},
      {{"render", "bed.h5", "--map", "pressure", "--crop", "5,0,11,2"}, 64, "leaves the bed"},
      {{"render", "bed.h5", "--map", "pressure", "--crop", "0,0,5,50"}, 64, "leaves the bed"},
      {{"render", "bed.h5", "--map", "rotation", "--since", "3"}, 65, "1.50"},
      {{"render", "bed.h5", "--map", "pressure", "--at", "30"}, 65, "--at 30"},
      {{"render", "bed.h5", "--map", "pressure", "--flow"}, 65, "after_failure"},
      {{"render", "bed.h5", "--map", "pressure", "--frames", "0-99"}, 65, "there is no frame 99"},
  };
  for (const auto& [arguments, code, part] : cases) {
    const Outcome outcome = talus(arguments);
    EXPECT_EQ(outcome.exit_code, code) << outcome.err;
    EXPECT_NE(outcome.err.find(part), std::string::npos) << part << ": " << outcome.err;
    EXPECT_FALSE(fs::exists(folder_.path() / "bed-maps")) << "nothing is created before all checks";
  }
}

TEST_F(MapCommands, pictures_are_named_by_layers_and_angle) {
  make_run();
  const Outcome outcome = render({"--map", "gamma+forces,displacement", "--every", "0.5", "-o", "maps"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(files("maps"), (std::set<std::string>{"gamma+forces_000.00.png", "gamma+forces_000.50.png",
                                                  "gamma+forces_001.00.png", "gamma+forces_001.50.png",
                                                  "displacement_000.00.png", "displacement_000.50.png",
                                                  "displacement_001.00.png", "displacement_001.50.png"}));
  const std::string picture = file_bytes(folder_.path() / "maps/gamma+forces_001.00.png");
  EXPECT_NE(picture.find("bed.h5, frame at 1.000 deg, gamma+forces"), std::string::npos);
  EXPECT_NE(picture.find("Software"), std::string::npos);
}

TEST_F(MapCommands, every_map_and_option_draws) {
  make_run();
  const std::vector<Words> cases = {
      {"--map",
       "gamma,overloaded,clusters,coarse,pressure,displacement,rotation,forces,critical,speed,nonaffine,"
       "shear,dilation,"
       "vorticity,coordination,mobilised,rigid,size,cells,density,stress,shear_rate,temperature,dyed",
       "--length", "3"},
      {"--map", "coarse+displacement", "--length", "3", "--since", "0.5", "--turned", "--colours", "cividis"},
      {"--map", "clusters+critical", "--joined", "neighbours", "--threshold", "2", "--transparent", "--trace",
       "overloaded,largest_cluster,stress_ratio,volume_strain"},
      {"--map", "pressure", "--range", "0,5", "--colours", "diverging", "--crop", "2,0,8,3", "--bare"},
  };
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const std::string name = "maps" + std::to_string(k);
    const Outcome outcome = render(cases[k] + Words{"--at", "1", "--width", "600", "-o", name});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(files(name.c_str()).size(), k == 0 ? 24u : 1u);
  }
}

TEST_F(MapCommands, pictures_that_exist_are_replaced_only_when_told) {
  make_run();
  const Words map = {"render", "bed.h5", "--map", "pressure", "--at", "1", "-o", "maps"};
  const Words panel = {"panel", "bed.h5", "--map", "pressure", "--at", "0,1", "-o", "panel.png"};
  for (const auto& [command, name] : {std::pair{map, "maps/pressure_001.00.png"}, {panel, "panel.png"}}) {
    ASSERT_EQ(talus(command).exit_code, 0);
    const std::string bytes = file_bytes(folder_.path() / name);
    const Outcome again = talus(command + Words{"--turned"});
    EXPECT_EQ(again.exit_code, 73) << name;
    EXPECT_NE(again.err.find(std::string(name) + " exists; give --overwrite"), std::string::npos)
        << again.err;
    EXPECT_EQ(file_bytes(folder_.path() / name), bytes);
    EXPECT_EQ(talus(command + Words{"--turned", "--overwrite"}).exit_code, 0);
    EXPECT_NE(file_bytes(folder_.path() / name), bytes);
  }
}

TEST_F(MapCommands, a_foreign_file_is_refused_before_anything_is_drawn) {
  make_run();
  fs::create_directory(folder_.path() / "maps");
  write_file(folder_, "maps/pressure_001.50.png", "precious");
  EXPECT_EQ(render({"--map", "pressure", "--every", "0.5", "-o", "maps"}).exit_code, 73);
  EXPECT_EQ(files("maps"), (std::set<std::string>{"pressure_001.50.png"}));
  EXPECT_EQ(file_bytes(folder_.path() / "maps/pressure_001.50.png"), "precious");
  write_file(folder_, "file", "");
  EXPECT_EQ(render({"--map", "pressure", "-o", "file/maps"}).exit_code, 73) << "not a folder";
}

TEST_F(MapCommands, a_frame_has_the_same_colours_alone_as_among_all) {
  make_run();
  const Words clusters = {"--map", "clusters", "--threshold", "0.5"};
  ASSERT_EQ(render(clusters + Words{"--at", "1.5", "-o", "one"}).exit_code, 0);
  ASSERT_EQ(render(clusters + Words{"--every", "0.5", "-o", "all"}).exit_code, 0);
  EXPECT_EQ(file_bytes(folder_.path() / "one/clusters_001.50.png"),
            file_bytes(folder_.path() / "all/clusters_001.50.png"));
}

TEST_F(MapCommands, without_a_context_nothing_is_made) {
  make_run();
  const Words broken = {"LD_LIBRARY_PATH=" + folder_.path().string()};
  for (const char* library : {"libOSMesa.so.8", "libEGL.so.1"})
    write_file(folder_, library, "no library, but longer than a header " + std::string(100, '.'));
  const auto draw = [&](const Words& words) { return run_talus(words, folder_.path(), broken); };
  const Outcome outcome = draw({"render", "bed.h5", "--map", "pressure", "-o", "maps"});
  const Outcome run = draw({"run", "bed.toml", "-o", "more.h5", "--pictures", "frames", "--map", "pressure"});
  EXPECT_EQ(outcome.exit_code, 69);
  EXPECT_NE(outcome.err.find("libOSMesa.so.8"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(folder_.path() / "maps"));
  EXPECT_EQ(run.exit_code, 69) << "it would compute for hours and draw nothing";
  EXPECT_FALSE(fs::exists(folder_.path() / "more.h5.run"));
}

TEST_F(MapCommands, no_variable_of_a_driver_changes_a_picture_or_costs_a_run) {
  make_run();
  const Words variables = {"GALLIUM_DRIVER=swr",
                           "MESA_GLSL_VERSION_OVERRIDE=110",
                           "LP_NATIVE_VECTOR_WIDTH=1",
                           "__EGL_VENDOR_LIBRARY_DIRS=/nowhere",
                           "LIBGL_DRIVERS_PATH=/nowhere",
                           "LIBGL_ALWAYS_SOFTWARE=0",
                           "EGL_PLATFORM=x11",
                           "DISPLAY=:99"};
  const Words map = {"--map", "pressure", "--width", "300"};
  for (const Words& command :
       std::vector<Words>{Words{"render", "../bed.h5", "--at", "1", "-o", "maps"} + map,
                          Words{"render", "../bed.h5", "--at", "1", "--context", "egl", "-o", "by_egl"} + map,
                          Words{"panel", "../bed.h5", "--at", "0,1", "-o", "panel.png"} + map,
                          Words{"run", "../bed.toml", "-o", "run.h5", "--pictures", "live"} + map}) {
    for (const char* folder : {"plain", "disturbed"}) {
      fs::create_directory(folder_.path() / folder);
      const Outcome outcome =
          run_talus(command, folder_.path() / folder, folder == std::string("plain") ? Words{} : variables);
      EXPECT_EQ(outcome.exit_code, 0) << command[0] << ": " << outcome.err;
    }
  }
  for (const char* picture : {"maps/pressure_001.00.png", "by_egl/pressure_001.00.png", "panel.png",
                              "live/pressure_000.00.png", "live/pressure_001.50.png"}) {
    const auto pixels = [&](const char* folder) {  // the texts name the folder
      const std::string bytes = file_bytes(folder_.path() / folder / picture);
      return bytes.substr(std::min(bytes.find("IDAT"), bytes.size()));
    };
    EXPECT_FALSE(pixels("plain").empty()) << picture;
    EXPECT_TRUE(pixels("disturbed") == pixels("plain")) << picture;
  }
}

TEST_F(MapCommands, a_full_disk_leaves_no_part_of_a_picture) {
  make_run();
  // The size limit of one block makes writing fail as on a full disk.
  const std::string command = "cd '" + folder_.path().string() + "' && ulimit -f 1 && trap '' XFSZ && '" +
                              talus_program() + "' render bed.h5 --map pressure -o maps 2> /dev/null";
  const int status = std::system(("sh -c \"" + command + "\"").c_str());
  EXPECT_EQ(WEXITSTATUS(status), 74);
  EXPECT_EQ(files("maps"), std::set<std::string>{});
}

TEST_F(MapCommands, a_stopped_job_leaves_whole_pictures) {
  make_run();
  const Words job = {"render",  "bed.h5", "--map",   "pressure,rotation,forces,critical,displacement",
                     "--every", "0.5",    "--width", "6000",
                     "-o",      "maps"};
  const pid_t process = start_talus(job, folder_.path());
  for (int wait = 0; wait < 1000 && files("maps").empty(); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(process, SIGTERM);
  ASSERT_EQ(wait_for(process), 75) << "it finished before it could be stopped, so nothing was tested";
  EXPECT_LT(files("maps").size(), 20u);
  for (const std::string& name : files("maps"))
    EXPECT_TRUE(file_bytes(folder_.path() / "maps" / name).ends_with("IEND\xae\x42\x60\x82")) << name;
}

bool is_alive(const std::string& process) {
  const std::string status = text_of("/proc/" + process + "/stat");
  return !status.empty() && status.find(") Z ") == std::string::npos;
}

/// Adds a folder to PATH during its lifetime.
class ProgramsFirst {
 public:
  explicit ProgramsFirst(const std::string& folder) { setenv("PATH", (folder + ":" + before_).c_str(), 1); }
  ~ProgramsFirst() { setenv("PATH", before_.c_str(), 1); }
  ProgramsFirst(const ProgramsFirst&) = delete;
  ProgramsFirst& operator=(const ProgramsFirst&) = delete;

 private:
  std::string before_ = std::getenv("PATH");
};

// An ffmpeg that neither reads nor ends, and has started a program that writes messages without end.
TEST_F(MapCommands, a_movie_that_is_ended_leaves_no_process_and_a_stopped_one_no_file) {
  make_run();
  const std::string started = folder_.path("started");
  fs::create_directory(folder_.path("tools"));
  write_file(folder_, "tools/ffmpeg",
             "#!/bin/sh\n(while :; do echo noise noise noise; done) >&2 &\necho $! > '" + started +
                 "'\nexec sleep 60\n");
  fs::permissions(folder_.path("tools/ffmpeg"), fs::perms::owner_all);
  const ProgramsFirst tools(folder_.path("tools"));
  for (const int signal : {SIGINT, SIGKILL}) {
    fs::remove(started);
    const pid_t process =
        start_talus({"animate", "bed.h5", "--map", "pressure", "-o", "m.mp4"}, folder_.path());
    while (!has_ended(process) && !text_of(started).ends_with('\n'))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::string messenger = text_of(started);
    messenger.pop_back();
    EXPECT_TRUE(is_alive(messenger));
    kill(process, signal);
    EXPECT_EQ(wait_for(process), signal == SIGINT ? 75 : -1);
    for (int wait = 0; wait < 1000 && is_alive(messenger); ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_FALSE(is_alive(messenger)) << "after signal " << signal;
    EXPECT_EQ(fs::exists(folder_.path("m.mp4.talus.part")), signal == SIGKILL);
    EXPECT_FALSE(fs::exists(folder_.path("m.mp4")));
  }
}

TEST_F(MapCommands, frames_are_taken_by_their_numbers) {
  make_run();
  ASSERT_EQ(talus({"render", "bed.h5", "--map", "pressure", "--frames", "0,2-3", "-o", "maps"}).exit_code, 0);
  EXPECT_EQ(files("maps").size(), 3u);
  EXPECT_TRUE(fs::exists(folder_.path() / "maps/pressure_001.00.png"));
  EXPECT_EQ(talus({"render", "bed.h5", "--map", "pressure", "--frames", "0", "--at", "1"}).exit_code, 64);
}

TEST_F(MapCommands, a_panel_stacks_angles_and_sets_maps_beside_each_other) {
  make_run();
  const Words one = {"panel", "bed.h5", "--map", "pressure", "--width", "600"};
  const auto shape = [this](const char* name) { return picture_size(folder_.path() / name); };
  ASSERT_EQ(talus(one + Words{"--at", "0", "-o", "one.png"}).exit_code, 0);
  ASSERT_EQ(talus(one + Words{"--at", "0,0.5,1", "-o", "three.png"}).exit_code, 0);
  const Words two = {"panel", "bed.h5", "--map", "pressure,forces", "--at", "0,0.5,1", "--width", "1200"};
  const Outcome made = talus(two + Words{"-o", "two.png"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(shape("three.png").width, 600);
  EXPECT_GT(shape("three.png").height, 2 * shape("one.png").height);
  EXPECT_LT(shape("three.png").height, 3 * shape("one.png").height) << "one legend for all";
  EXPECT_EQ(shape("two.png").width, 1200);
  for (const char* document : {"one.pdf", "one.svg"})
    EXPECT_EQ(talus(one + Words{"--at", "0", "-o", document}).exit_code, 0);
  EXPECT_EQ(talus(one + Words{"--at", "0,1", "--bare", "-o", "bare.png"}).exit_code, 0);
}

TEST_F(MapCommands, a_movie_follows_the_tilt) {
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not installed";
  make_run();
  const Words movie = {"animate", "bed.h5", "--map", "pressure", "--width", "300"};
  const Outcome plain = talus(movie + Words{"-o", "a.gif"});
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_NE(plain.out.find("4 frames, 0.4 s"), std::string::npos) << plain.out;
  // 1.5 deg in 3 s at 10 frames per second; the last frame is held for another second.
  const Outcome timed = talus(movie + Words{"--speed", "0.5", "-o", "b.webm"});
  ASSERT_EQ(timed.exit_code, 0) << timed.err;
  EXPECT_NE(timed.out.find("41 frames, 4.1 s"), std::string::npos) << timed.out;
  EXPECT_EQ(talus(movie + Words{"-o", "a.gif"}).exit_code, 73);
  const Outcome held = talus(movie + Words{"--speed", "0.5", "--hold", "0.5", "-o", "c.webm"});
  EXPECT_NE(held.out.find("41 frames, 4.1 s"), std::string::npos) << held.out << "half a second at each end";
  EXPECT_NE(held.out.find("output.frame_every = 0.05"), std::string::npos) << held.out;
}

TEST_F(MapCommands, a_run_without_frames_has_no_maps) {
  write_file(folder_, "long.toml", "[bed]\nlength = 50\ndepth = 20\n[output]\ncheckpoint_every = 0\n");
  const pid_t process = start_talus({"run", "long.toml", "-o", "bed.h5"}, folder_.path());
  for (int wait = 0; wait < 1000 && !fs::exists(folder_.path() / "bed.h5.run/manifest"); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(process, SIGKILL);
  wait_for(process);
  const Outcome outcome = render({"--map", "pressure"});
  EXPECT_EQ(outcome.exit_code, 65);
  EXPECT_NE(outcome.err.find("no frames"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace talus::test
