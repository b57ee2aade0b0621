/// Maps drawn from a run file: file names, kept files, rejected requests, interruptions, movies, panels.

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "base/hash.h"
#include "io/packed_file.h"
#include "pictures.h"
#include "support/commands.h"
#include "support/runs.h"
#include "support/variable.h"
#include "unit/io/example_run.h"

namespace talus::test {
namespace {

namespace fs = std::filesystem;

/// Bed of 40 grains with frames at 0, 0.5, 1 and 1.5 deg.
const char* const tiny_bed =
    "seed = 3\n[bed]\nlength = 10\ndepth = 4\n[tilt]\nstep = 0.01\nend_angle = 1.5\n[output]\nframe_every = "
    "0.5\n";

class MapCommands : public CommandTest {
 protected:
  MapCommands() : CommandTest(tiny_bed) { take_run(folder_, "bed.h5", tiny_bed); }

  /// The bed remains stable, so its theta_c is unknown.
  Outcome render(const Words& more) { return talus(Words{"render", "bed.h5"} + more); }
  std::set<std::string> files(const char* name) { return names_in(folder_.path() / name); }
};

TEST_F(MapCommands, refuse_what_makes_no_sense_before_they_look_for_the_run) {
  const std::vector<std::pair<Words, std::string>> cases = {
      {{"--map", "gamm"}, "gamma"},
      {{"--map", "spin"}, "there is no run none.h5"},
      {{"--map", "gamma+forces+critical"}, "two"},
      {{"--map", "gamma,gamma"}, "twice"},
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
      {{"--map", "gamma", "--set", "length=5"}, "coarse"},
      {{"--map", "gamma", "--since", "1"}, "displacement"},
      {{"--map", "gamma", "--set", "joining=neighbours"}, "clusters"},
      {{"--map", "pressure", "--set", "threshold_factors=2"}, "Gamma_c"},
      {{"--map", "coarse", "--set", "l_min=0"}, "gamma of grains"},
      {{"--map", "gamma", "--set", "gamma_c=0.01"}, "from 0.035 to 0.9998"},
      {{"--map", "gamma", "--bare", "--trace", "overloaded"}, "--bare"},
      {{"--map", "gamma", "--bare", "--for", "slide"}, "--bare"},
      {{"--map", "gamma", "--for", "slides"}, "did you mean 'slide'?"},
      {{"--map", "gamma", "--format", "eps"}, "svg"},
      {{"--size", "1cm"}, "a width from 4 to 200 cm"},
      {{"--size", "8.6x0.5cm"}, "an eighth"},
      {{"--size", "1000000"}, "200 to 16384 pixels on each side"},
      {{"--size", "20"}, "200 to 16384 pixels"},
      {{"--size", "1920x100"}, "200 to 16384 pixels"},
  };
  for (const auto& [arguments, part] : cases)
    EXPECT_TRUE(ends(talus(Words{"render", "none.h5"} + arguments), 64, {part}));
  const std::vector<std::pair<Words, std::string>> others = {
      {{"animate", "none.h5", "--map", "gamma", "-o", "x.mp4", "--transparent"}, "transparen"},
      {{"animate", "none.h5", "--size", "300"}, "2 maps"},
      {{"render", "none.h5", "--map", "gamma", "--colours", "gray,viridis"}, "one for clusters"},
      {{"panel", "none.h5", "--map", "gamma", "--at", "0", "-o", "x.png", "--title", "a", "--bare"},
       "--title"},
      {{"animate", "none.h5", "--map", "gamma", "-o", "x.avi"}, ".webm"},
      {{"render", "none.h5", "--map", "gamma", "--at", "0", "-o", "x.png"}, "x.png: expected a folder"},
      {{"panel", "none.h5", "--map", "gamma", "--at", "0", "-o", "x.png", "--trace", "overloaded"},
       "--trace"},
      {{"panel", "none.h5", "--map", "gamma,overloaded,forces", "--at", "0", "-o", "x.png", "--size", "500"},
       "--size 500"},
      {{"panel", "none.h5", "--map", "gamma", "--at", "0", "-o", "x.jpg"}, ".svg"},
      {{"panel", "none.h5", "--map", "gamma", "--at", "0", "-o", "x.png", "--title", "日本"}, "Latin-1"},
      {{"panel", "none.h5", "--map", "gamma", "--at", "0", "-o", "x.png", "--title", "a\nb"}, "Latin-1"},
      {{"run", "none.toml", "--map", "gamma"}, "--pictures"},
      {{"run", "none.toml", "--pictures", "maps", "--map", "gamm"}, "gamma"},
  };
  for (const auto& [arguments, part] : others) EXPECT_TRUE(ends(talus(arguments), 64, {part}));
  for (const char* size :
       {"640.5x480", "1920x-1080", "x480", "640x", "640x480x2", "8.6 mm", "0", "nan", "px"})
    for (const char* command : {"render", "panel", "animate"})
      EXPECT_EQ(talus({command, "none.h5", "--size", size}).exit_code, 64) << command << " " << size;
  for (const char* setting : {"joining=glue", "l_min=-1", "length=0", "averaging=1", "gamma_c"})
    EXPECT_EQ(talus({"render", "none.h5", "--set", setting}).exit_code, 65) << setting;
}

TEST_F(MapCommands, refuse_what_the_run_does_not_have) {
  const std::vector<std::tuple<Words, int, std::string>> cases = {
      {{"render", "bed.h5", "--map", "pressure", "--crop", "5,0,11,2"}, 64, "leaves the bed"},
      {{"render", "bed.h5", "--map", "pressure", "--crop", "0,0,5,50"}, 64, "leaves the bed"},
      {{"render", "bed.h5", "--map", "rotation", "--since", "3"}, 65, "1.50"},
      {{"render", "bed.h5", "--map", "pressure", "--at", "30"}, 65, "--at 30"},
      {{"render", "bed.h5", "--map", "pressure", "--flow"}, 65, "after_failure"},
      {{"render", "bed.h5", "--map", "pressure", "--at", "frame0-frame99"}, 65, "frame0 to frame3"},
      {{"render", "bed.h5", "--set", "gamma_c=0.02", "--at", "repose"}, 64, "gamma_c=0.02"},
      {{"render", "bed.h5", "--set", "gamma_c=0.342", "--at", "repose"}, 65, "has not failed"},
      {{"render", "bed.h5", "--map", "pressure", "--at", "repose"}, 65, "the slope has not failed"},
  };
  for (const auto& [arguments, code, part] : cases) {
    EXPECT_TRUE(ends(talus(arguments), code, {part}));
    EXPECT_FALSE(folder_.has_file("bed-maps")) << "nothing is created before all checks";
  }
}

TEST_F(MapCommands, pictures_are_named_by_layers_and_angle) {
  ASSERT_TRUE(ends(render({"--map", "gamma+forces,displacement", "--every", "0.5", "-o", "maps"}), 0));
  EXPECT_EQ(files("maps"), (std::set<std::string>{"gamma+forces_000.00.png", "gamma+forces_000.50.png",
                                                  "gamma+forces_001.00.png", "gamma+forces_001.50.png",
                                                  "displacement_000.00.png", "displacement_000.50.png",
                                                  "displacement_001.00.png", "displacement_001.50.png"}));
  EXPECT_TRUE(has_all(folder_.text("maps/gamma+forces_001.00.png"),
                      {"bed.h5, frame at 1.000 deg, gamma+forces", "Software"}));
}

TEST_F(MapCommands, values_stored_with_the_run_are_drawn_listed_and_exported) {
  const std::string path = folder_.path("bed.h5");
  const io::RunFile run = io::RunFile::open(path);
  const std::size_t grains = run.header().statics.radius.size();
  OwnQuantity slip{{}, OwnQuantity::Kind::number, "v_s", "m/s", "slip", true},
      marked{{}, OwnQuantity::Kind::flag, "marked", "", "marked", false};
  for (std::size_t k = 0; k < 4 * grains; ++k) slip.values.push_back(0.5 * static_cast<double>(k));
  marked.values.assign(run.contact_count(), 1.0);
  for (const OwnQuantity& own : {slip, marked})
    io::store_own(path, own, hash_text(state_hash(run.checkpoint().world)));
  ASSERT_TRUE(ends(talus({"render", "bed.h5", "--map", "slip,marked", "--at", "0", "-o", "maps"}), 0));
  EXPECT_EQ(files("maps"), (std::set<std::string>{"slip_000.00.png", "marked_000.00.png"}));
  EXPECT_TRUE(
      ends(talus({"panel", "bed.h5", "--map", "slip,gamma", "--set", "gamma_c=0.3"}), 0, {"3 angles"}));
  EXPECT_TRUE(ends(talus({"render", "bed.h5", "--map", "slap"}), 64, {"gamma, ", "did you mean 'slip'?"}));
  EXPECT_TRUE(ends(talus({"render", "bed.h5", "--map", "slip", "--set", "length=5"}), 64, {"coarse"}));
  EXPECT_TRUE(ends(talus({"info", "bed.h5"}), 0, {"slip", "v_s in m/s, of grains", "marked, of contacts"}));
  EXPECT_TRUE(ends(talus({"export", "bed.h5", "--to", "csv", "--at", "0", "-o", "csv"}), 0));
  const std::string table = folder_.text("csv/grains.csv");
  EXPECT_TRUE(has(table.substr(0, table.find('\n')), ",slip (m/s)"));
  EXPECT_TRUE(has(table, ",0.5\n")) << "grain 1";
  EXPECT_TRUE(has_all(folder_.text("csv/contacts.csv"), {",marked\n", ",1\n"}));
  EXPECT_TRUE(ends(talus({"check", "bed.h5"}), 0));
  EXPECT_TRUE(ends(talus({"analyze", "bed.h5", "--set", "gamma_c=0.3"}), 0));
  EXPECT_TRUE(ends(talus({"info", "bed.h5"}), 0, {"slip"})) << "kept with the analysis";
}

TEST_F(MapCommands, every_map_and_option_draws) {
  const std::vector<Words> cases = {
      {"--map",
       "gamma,overloaded,clusters,coarse,pressure,displacement,rotation,forces,critical,speed,nonaffine,"
       "shear,dilation,"
       "vorticity,coordination,mobilised,rigid,size,cells,density,stress,shear_rate,temperature,dyed",
       "--set", "length=3"},
      {"--map", "coarse+displacement", "--set", "length=3", "--since", "0.5", "--turned", "--colours",
       "cividis"},
      {"--map", "clusters+critical", "--set", "joining=neighbours", "--set", "threshold_factors=2",
       "--transparent", "--trace", "overloaded,largest_cluster,stress_ratio,volume_strain"},
      {"--map", "pressure", "--range", "0,5", "--colours", "diverging", "--crop", "2,0,8,3", "--bare"},
  };
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const std::string name = "maps" + std::to_string(k);
    const Outcome outcome = render(cases[k] + Words{"--at", "1", "--size", "600", "-o", name});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(files(name.c_str()).size(), k == 0 ? 24u : 1u);
  }
}

TEST_F(MapCommands, pictures_that_exist_are_replaced_only_when_told) {
  const Words map = {"render", "bed.h5", "--map", "pressure", "--at", "1", "-o", "maps"};
  const Words panel = {"panel", "bed.h5", "--map", "pressure", "--at", "0,1", "-o", "panel.png"};
  for (const auto& [command, name] : {std::pair{map, "maps/pressure_001.00.png"}, {panel, "panel.png"}}) {
    ASSERT_EQ(talus(command).exit_code, 0);
    const std::string bytes = folder_.text(name);
    EXPECT_TRUE(
        ends(talus(command + Words{"--turned"}), 73, {std::string(name) + " exists; give --overwrite"}))
        << name;
    EXPECT_EQ(folder_.text(name), bytes);
    EXPECT_EQ(talus(command + Words{"--turned", "--overwrite"}).exit_code, 0);
    EXPECT_NE(folder_.text(name), bytes);
  }
}

TEST_F(MapCommands, a_foreign_file_is_refused_before_anything_is_drawn) {
  fs::create_directory(folder_.path() / "maps");
  write_file(folder_, "maps/pressure_001.50.png", "precious");
  EXPECT_EQ(render({"--map", "pressure", "--every", "0.5", "-o", "maps"}).exit_code, 73);
  EXPECT_EQ(files("maps"), (std::set<std::string>{"pressure_001.50.png"}));
  EXPECT_EQ(folder_.text("maps/pressure_001.50.png"), "precious");
  write_file(folder_, "file", "");
  EXPECT_EQ(render({"--map", "pressure", "-o", "file/maps"}).exit_code, 73) << "not a folder";
}

TEST_F(MapCommands, a_frame_has_the_same_colours_alone_as_among_all) {
  const Words clusters = {"--map", "clusters", "--set", "threshold_factors=0.5"};
  ASSERT_EQ(render(clusters + Words{"--at", "1.5", "-o", "one"}).exit_code, 0);
  ASSERT_EQ(render(clusters + Words{"--every", "0.5", "-o", "all"}).exit_code, 0);
  EXPECT_EQ(folder_.text("one/clusters_001.50.png"), folder_.text("all/clusters_001.50.png"));
}

TEST_F(MapCommands, without_a_context_nothing_is_made) {
  const Words broken = {"LD_LIBRARY_PATH=" + folder_.path().string()};
  for (const char* library : {"libOSMesa.so.8", "libEGL.so.1"})
    write_file(folder_, library, "no library, but longer than a header " + std::string(100, '.'));
  const auto draw = [&](const Words& words) { return folder_.talus(words, broken); };
  const Outcome outcome = draw({"render", "bed.h5", "--map", "pressure", "-o", "maps"});
  const Outcome run = draw({"run", "bed.toml", "-o", "more.h5", "--pictures", "frames", "--map", "pressure"});
  EXPECT_EQ(outcome.exit_code, 69);
  EXPECT_TRUE(has(outcome.err, "libOSMesa.so.8"));
  EXPECT_FALSE(folder_.has_file("maps"));
  EXPECT_EQ(run.exit_code, 69) << "it would compute for hours and draw nothing";
  EXPECT_FALSE(folder_.has_file("more.h5.run"));
}

TEST_F(MapCommands, no_variable_of_a_driver_changes_a_picture_or_costs_a_run) {
  const Words variables = {"GALLIUM_DRIVER=swr",
                           "MESA_GLSL_VERSION_OVERRIDE=110",
                           "LP_NATIVE_VECTOR_WIDTH=1",
                           "__EGL_VENDOR_LIBRARY_DIRS=/nowhere",
                           "LIBGL_DRIVERS_PATH=/nowhere",
                           "LIBGL_ALWAYS_SOFTWARE=0",
                           "EGL_PLATFORM=x11",
                           "DISPLAY=:99"};
  const Words map = {"--map", "pressure", "--size", "300"};
  for (const Words& command :
       std::vector<Words>{Words{"render", "../bed.h5", "--at", "1", "-o", "maps"} + map,
                          Words{"render", "../bed.h5", "--at", "1", "--context", "egl", "-o", "by_egl"} + map,
                          Words{"panel", "../bed.h5", "--at", "0,1", "-o", "panel.png"} + map,
                          Words{"run", "../bed.toml", "-o", "run.h5", "--pictures", "live"} + map}) {
    for (const char* folder : {"plain", "disturbed"}) {
      fs::create_directory(folder_.path() / folder);
      EXPECT_TRUE(ends(
          run_talus(command, folder_.path() / folder, folder == std::string("plain") ? Words{} : variables),
          0))
          << command[0];
    }
  }
  for (const char* picture : {"maps/pressure_001.00.png", "by_egl/pressure_001.00.png", "panel.png",
                              "live/pressure_000.00.png", "live/pressure_001.50.png"}) {
    const auto pixels = [&](const char* folder) {  // the texts name the folder
      const std::string bytes = text_of(folder_.path() / folder / picture);
      return bytes.substr(std::min(bytes.find("IDAT"), bytes.size()));
    };
    EXPECT_FALSE(pixels("plain").empty()) << picture;
    EXPECT_TRUE(pixels("disturbed") == pixels("plain")) << picture;
  }
}

TEST_F(MapCommands, a_stopped_job_leaves_whole_pictures) {
  const Words job = {"render",  "bed.h5", "--map",  "pressure,rotation,forces,critical,displacement",
                     "--every", "0.5",    "--size", "6000",
                     "-o",      "maps"};
  const pid_t process = folder_.start(job);
  wait_until([&] { return !(files("maps").empty()); });
  kill(process, SIGTERM);
  ASSERT_EQ(wait_for(process), 75) << "it finished before it could be stopped, so nothing was tested";
  EXPECT_LT(files("maps").size(), 20u);
  for (const std::string& name : files("maps"))
    EXPECT_TRUE(text_of(folder_.path() / "maps" / name).ends_with("IEND\xae\x42\x60\x82")) << name;
}

bool is_alive(const std::string& process) {
  const std::string status = text_of("/proc/" + process + "/stat");
  return !status.empty() && !has(status, ") Z ");
}

// An ffmpeg that neither reads nor ends, and has started a program that writes messages without end.
TEST_F(MapCommands, a_movie_that_is_ended_leaves_no_process_and_a_stopped_one_no_file) {
  const std::string started = folder_.path("started");
  fs::create_directory(folder_.path("tools"));
  write_file(folder_, "tools/ffmpeg",
             "#!/bin/sh\n(while :; do echo noise noise noise; done) >&2 &\necho $! > '" + started +
                 "'\nexec sleep 60\n");
  fs::permissions(folder_.path("tools/ffmpeg"), fs::perms::owner_all);
  const Variable tools("PATH", folder_.path("tools") + ":" + std::getenv("PATH"));
  for (const int signal : {SIGINT, SIGKILL}) {
    fs::remove(started);
    const pid_t process = folder_.start({"animate", "bed.h5", "--map", "pressure", "-o", "m.mp4"});
    wait_until([&] { return has_ended(process) || text_of(started).ends_with('\n'); });
    std::string messenger = text_of(started);
    messenger.pop_back();
    EXPECT_TRUE(is_alive(messenger));
    kill(process, signal);
    EXPECT_EQ(wait_for(process), signal == SIGINT ? 75 : -1);
    wait_until([&] { return !(is_alive(messenger)); });
    EXPECT_FALSE(is_alive(messenger)) << "after signal " << signal;
    EXPECT_EQ(folder_.has_file("m.mp4.talus.part"), signal == SIGKILL);
    EXPECT_FALSE(folder_.has_file("m.mp4"));
  }
}

TEST_F(MapCommands, without_a_map_draw_the_two_of_the_paper) {
  ASSERT_EQ(render({}).exit_code, 0);
  std::set<std::string> expected;  // every degree, and the last before failure
  for (const char* map : {"gamma", "overloaded"})
    for (const char* angle : {"000.00", "001.00", "001.50"})
      expected.insert(std::string(map) + "_" + angle + ".png");
  EXPECT_EQ(files("bed-maps"), expected);
  const Words size = {"--size", "600"};
  const Outcome panel = talus(Words{"panel", "bed.h5"} + size);
  EXPECT_EQ(panel.out, "bed-panel.png: 3 angles\n") << panel.err;
  const Words live = {"run", "bed.toml", "-o", "live.h5", "--pictures", "live", "--set", "gamma_c=0.342"};
  EXPECT_FALSE(has(talus(live + size).err, "note")) << "Gamma_c is given";
  EXPECT_EQ(files("live").size(), 8u);
  EXPECT_TRUE(files("live").contains("overloaded_001.50.png"));
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not installed";
  const Outcome movie = talus(Words{"animate", "bed.h5"} + size);
  EXPECT_TRUE(movie.out.starts_with("bed-maps.mp4: 4 frames")) << movie.err;
}

TEST_F(MapCommands, sizes_have_the_same_forms_everywhere) {
  struct Case {
    const char* size;
    int width, height;  ///< px; height 0: that of the bed
  };
  for (const auto& [size, width, height] :
       {Case{"700", 700, 0}, {"640x480", 640, 480}, {"8.6cm", 1600, 0}, {"12x9cm", 1600, 1200}}) {
    const Words asked = {"bed.h5", "--map", "pressure", "--at", "0,1", "--size", size, "--overwrite"};
    ASSERT_EQ(talus(Words{"render"} + asked).exit_code, 0) << size;
    ASSERT_EQ(talus(Words{"panel"} + asked).exit_code, 0) << size;
    const PictureSize picture = picture_size(folder_.path() / "bed-maps/pressure_001.00.png"),
                      panel = picture_size(folder_.path() / "bed-panel.png");
    EXPECT_EQ(picture.width, width);
    EXPECT_EQ(panel.width, width);
    if (height == 0) continue;
    EXPECT_EQ(picture.height, height);
    EXPECT_EQ(panel.height, height);
  }
  EXPECT_TRUE(has(folder_.text("bed-panel.png"), "pHYs"));
}

TEST_F(MapCommands, a_panel_stacks_angles_and_sets_maps_beside_each_other) {
  const Words one = {"panel", "bed.h5", "--map", "pressure", "--size", "600"};
  const auto shape = [this](const char* name) { return picture_size(folder_.path() / name); };
  ASSERT_EQ(talus(one + Words{"--at", "0", "-o", "one.png"}).exit_code, 0);
  ASSERT_EQ(talus(one + Words{"--at", "0,0.5,1", "-o", "three.png"}).exit_code, 0);
  const Words two = {"panel", "bed.h5", "--map", "pressure,forces", "--at", "0,0.5,1", "--size", "1200"};
  ASSERT_TRUE(ends(talus(two + Words{"-o", "two.png"}), 0));
  EXPECT_EQ(shape("three.png").width, 600);
  EXPECT_GT(shape("three.png").height, 2 * shape("one.png").height);
  EXPECT_LT(shape("three.png").height, 3 * shape("one.png").height) << "one legend for all";
  EXPECT_EQ(shape("two.png").width, 1200);
  for (const char* document : {"one.pdf", "one.svg"})
    EXPECT_EQ(talus(one + Words{"--at", "0", "-o", document}).exit_code, 0);
  EXPECT_EQ(talus(one + Words{"--at", "0,1", "--bare", "-o", "bare.png"}).exit_code, 0);
  const Outcome narrow =
      talus({"panel", "bed.h5", "--map", "pressure,forces,size,rotation", "--at", "0,1", "--size", "5cm"});
  EXPECT_TRUE(ends(narrow, 64, {"--size 5cm: 4 maps and their texts do not fit", "use --size "}));
  EXPECT_EQ(narrow.err.find("reading"), std::string::npos) << "it is refused before all frames are read";
}

TEST_F(MapCommands, of_a_run_without_frames_are_refused) {
  example::store_with_commits(folder_.path("begun.h5"), 1);
  for (const Words& words :
       {Words{"render", "begun.h5", "--map", "pressure"}, {"forces", "begun.h5", "--at", "0"}})
    EXPECT_TRUE(ends(talus(words), 65, {"begun.h5 has no frames yet"}));
}

TEST_F(MapCommands, a_movie_follows_the_tilt) {
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "ffmpeg is not installed";
  const Words movie = {"animate", "bed.h5", "--map", "pressure", "--size", "300"};
  ASSERT_TRUE(ends(talus(movie + Words{"-o", "a.gif"}), 0, {"4 frames, 0.4 s"}));
  // 1.5 deg in 3 s at 10 frames per second; the last frame is held for another second.
  ASSERT_TRUE(ends(talus(movie + Words{"--speed", "0.5", "-o", "b.webm"}), 0, {"41 frames, 4.1 s"}));
  EXPECT_EQ(talus(movie + Words{"-o", "a.gif"}).exit_code, 73);
  const Outcome held = talus(movie + Words{"--speed", "0.5", "--hold", "0.5", "-o", "c.webm"});
  EXPECT_TRUE(has(held.out, "41 frames, 4.1 s")) << "half a second at each end";
  EXPECT_TRUE(has(held.out, "output.frame_every = 0.05"));
}

}  // namespace
}  // namespace talus::test
