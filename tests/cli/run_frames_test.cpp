/// Maps drawn while a run computes, and runs that continue after failure.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <sstream>

#include "core/trigonometry.h"
#include "pictures.h"
#include "support/commands.h"
#include "support/runs.h"

namespace talus::test {
namespace {

namespace fs = std::filesystem;

/// Bed that is tilted fast: it fails, flows, and comes to rest again within a few seconds.
const char* const failing_bed =
    "seed = 2\n[bed]\nlength = 20\ndepth = 6\n[deposition]\nrest_velocity = 0.05\n"
    "[tilt]\nrate = 20\nstep = 0.02\nafter_failure = \"lower\"\nlowering_rate = 20\n"
    "[output]\nframe_every = 1\nobservable_every = 0.2\n";

class RunFrames : public CommandTest {
 protected:
  RunFrames() : CommandTest(failing_bed) {}

  const Words maps_ = {"--map", "clusters,displacement", "--size", "400"};
  Words run(const std::string& output, const std::string& maps, const Words& more = {}) {
    return Words{"run", "bed.toml", "-o", output, "--pictures", maps} + maps_ + more;
  }
};

TEST_F(RunFrames, do_not_change_the_run) {
  take_run(folder_, "plain.h5", failing_bed);
  const Outcome drawn = talus(run("drawn.h5", "maps"));
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  EXPECT_TRUE(has(drawn.err, "20 deg; --set gamma_c"));
  EXPECT_EQ(folder_.hash("drawn.h5"), folder_.hash("plain.h5"));
  const int tilt = std::stoi(info("drawn.h5", "frames"));
  const int flow = std::stoi(info("drawn.h5", "frames_after_failure"));
  ASSERT_GT(flow, 0);
  const std::set<std::string> names = names_in(folder_.path() / "maps");
  EXPECT_EQ(names.size(), 2u * static_cast<unsigned>(tilt + flow));
  EXPECT_TRUE(names.contains("clusters_000.00.png"));
  EXPECT_TRUE(names.contains("displacement_005.00.png"));
  EXPECT_TRUE(std::prev(names.end())->starts_with("displacement_flow_")) << *std::prev(names.end());
  const PictureSize first = picture_size(folder_.path() / "maps/clusters_000.00.png");
  EXPECT_EQ(first.width, 400);
  for (const std::string& name : names)
    if (name.starts_with("clusters")) {
      EXPECT_EQ(picture_size(folder_.path() / "maps" / name).height, first.height) << name;
    }
}

TEST_F(RunFrames, of_an_interrupted_run_are_those_of_a_whole_one) {
  const Words few = {"--resume", "--set", "output.frame_every=4"};
  ASSERT_EQ(talus(run("whole.h5", "whole", few)).exit_code, 0);
  int stops = 0;
  for (int attempt = 0; attempt < 40; ++attempt) {
    const pid_t process = folder_.start(run("parts.h5", "parts", few));
    pause_before(attempt, 150);
    kill(process, attempt % 2 == 0 ? SIGTERM : SIGKILL);
    const int code = wait_for(process);
    ASSERT_TRUE(code == 0 || code == 75 || code == -1) << code;
    if (code == 0) break;
    if (!names_in(folder_.path() / "parts").empty()) ++stops;
  }
  EXPECT_GT(stops, 0) << "it was never interrupted while drawing, so nothing was tested";
  ASSERT_TRUE(ends(talus(run("parts.h5", "parts", few)), 0));
  EXPECT_EQ(folder_.hash("parts.h5"), folder_.hash("whole.h5"));
  const std::set<std::string> parts = names_in(folder_.path() / "parts");
  ASSERT_EQ(parts, names_in(folder_.path() / "whole"));
  for (const std::string& name : parts)
    EXPECT_EQ(pixels_of(folder_.path() / "parts" / name), pixels_of(folder_.path() / "whole" / name)) << name;
}

TEST_F(RunFrames, of_a_complete_run_are_made_whole) {
  ASSERT_EQ(talus(run("whole.h5", "whole")).exit_code, 0);
  const std::set<std::string> names = names_in(folder_.path() / "whole");
  const fs::path last = folder_.path() / "whole" / *names.rbegin();
  const auto pixels = pixels_of(last);
  fs::remove(last);
  EXPECT_TRUE(ends(talus(run("whole.h5", "whole", {"--resume"})), 0));
  ASSERT_EQ(names_in(folder_.path() / "whole"), names);
  EXPECT_EQ(pixels_of(last), pixels);
}

TEST_F(RunFrames, that_cannot_be_written_do_not_lose_the_run) {
  take_run(folder_, "plain.h5", failing_bed);
  fs::create_directories(folder_.path() / "maps/clusters_005.00.png/x");  // prevents a file of that name
  EXPECT_TRUE(ends(talus(run("bed.h5", "maps", {"--overwrite"})), 73,
                   {"warning", "the run is complete, but its maps in maps are not"}));
  EXPECT_EQ(folder_.hash("bed.h5"), folder_.hash("plain.h5"));
  EXPECT_EQ(info("bed.h5", "complete"), "true");
}

TEST_F(RunFrames, refuse_before_anything_is_computed) {
  fs::create_directory(folder_.path() / "maps");
  write_file(folder_, "maps/clusters_000.00.png", "precious");
  EXPECT_TRUE(ends(talus(run("bed.h5", "maps")), 73, {"pictures of the map clusters"}));
  write_file(folder_, "file", "");
  EXPECT_EQ(talus(run("bed.h5", "file/maps")).exit_code, 73);
  EXPECT_FALSE(folder_.has_file("bed.h5.run"));
  EXPECT_EQ(folder_.text("maps/clusters_000.00.png"), "precious");
}

TEST_F(RunFrames, of_the_flow_are_drawn_from_the_file_too) {
  take_run(folder_, "bed.h5", failing_bed);
  ASSERT_TRUE(ends(talus({"render", "bed.h5", "--map", "clusters", "--every", "1", "--flow", "--size", "400",
                          "-o", "maps"}),
                   0));
  const std::set<std::string> names = names_in(folder_.path() / "maps");
  const auto flow = std::ranges::count_if(
      names, [](const std::string& name) { return name.starts_with("clusters_flow_"); });
  EXPECT_EQ(flow, std::stoi(info("bed.h5", "frames_after_failure")));
  EXPECT_TRUE(std::prev(names.end())->starts_with("clusters_flow_"));
}

/// Bed of 40 grains with few frames.
const char* const smaller_bed =
    "seed = 2\n[bed]\nlength = 10\ndepth = 4\n[deposition]\nrest_velocity = 0.05\n"
    "[tilt]\nrate = 20\nstep = 0.02\nafter_failure = \"lower\"\nlowering_rate = 5\n"
    "[output]\nframe_every = 5\nobservable_every = 0.2\n";

class AfterFailure : public CommandTest {
 protected:
  AfterFailure() : CommandTest(failing_bed) {}

  /// Waits until the process that writes the run commits again or ends.
  void wait_for_commit(pid_t process, const std::string& run) const {
    const auto committed = [&] {
      std::error_code none;  // for a run that has not begun
      return std::filesystem::last_write_time(folder_.path(run + ".run/manifest"), none);
    };
    const auto before = committed();
    wait_until([&] { return committed() != before || has_ended(process); });
  }
};

TEST_F(AfterFailure, the_angle_at_rest_is_told) {
  ASSERT_TRUE(ends(talus({"run", "bed.toml", "-o", "bed.h5"}), 0, {"theta_r = "}));
  const std::string theta_r = info("bed.h5", "theta_r_deg");
  ASSERT_NE(theta_r, "null");
  EXPECT_LT(std::stod(theta_r), std::stod(info("bed.h5", "theta_c_deg")));
  // A name implies its unit: the top level in degrees uses other names than results in radians.
  std::istringstream json(talus({"info", "bed.h5", "--json"}).out);
  std::map<std::string, int> keys;
  for (std::string line; std::getline(json, line);)
    if (const std::size_t at = line.find('"'); at == 2 || at == 4)
      ++keys[line.substr(at + 1, line.find('"', at + 1) - at - 1)];
  for (const char* key : {"theta_c", "theta_c_deg", "theta_r", "theta_r_deg"}) EXPECT_EQ(keys[key], 1) << key;
  EXPECT_NEAR(degrees(std::stod(info("bed.h5", "theta_c"))), std::stod(info("bed.h5", "theta_c_deg")), 1e-9);
  EXPECT_EQ(theta_r, info("bed.h5", "tilt_deg")) << "the only slope of a periodic bed";
  EXPECT_GT(std::stoi(info("bed.h5", "frames_after_failure")), 0);
  EXPECT_GT(std::stod(info("bed.h5", "tilt_last_deg")), std::stod(info("bed.h5", "theta_c_deg")))
      << "the last frame of the tilt is the frame of failure";
  EXPECT_TRUE(has(talus({"info", "bed.h5"}).out, "theta_r"));
}

TEST_F(AfterFailure, a_flow_that_does_not_stop_is_told) {
  ASSERT_TRUE(ends(talus({"run", "bed.toml", "-o", "bed.h5", "--set", "tilt.after_failure=hold", "--set",
                          "deposition.max_time=2"}),
                   0, {"had not stopped"}));
  EXPECT_EQ(info("bed.h5", "theta_r_deg"), "null");
}

TEST_F(AfterFailure, the_other_commands_see_the_tilt_alone) {
  take_run(folder_, "flow.h5", failing_bed);
  take_run(folder_, "stop.h5", failing_bed, {"--set", "tilt.after_failure=stop"});
  EXPECT_EQ(info("flow.h5", "frames"), info("stop.h5", "frames"));
  EXPECT_EQ(info("flow.h5", "theta_c_deg"), info("stop.h5", "theta_c_deg"));
  EXPECT_EQ(info("stop.h5", "theta_r_deg"), "null");
  EXPECT_FALSE(has(talus({"info", "stop.h5"}).out, "theta_r"));
  const auto table = [this](const std::string& run) {
    const std::string text = talus({"analyze", run}).out;
    return text.substr(text.find('\n'));  // without the name
  };
  const std::string stopped = table("stop.h5");
  EXPECT_TRUE(has(stopped, "theta_d by"));
  EXPECT_EQ(table("flow.h5"), stopped);
  EXPECT_EQ(table("flow.h5"), stopped) << "read from the file";
  ASSERT_EQ(talus({"render", "flow.h5", "--map", "gamma", "--at", "repose", "-o", "flow"}).exit_code, 0);
  ASSERT_EQ(talus({"render", "stop.h5", "--map", "gamma", "--at", "repose", "-o", "stop"}).exit_code, 0);
  const auto only_file = [this](const char* name) {
    return std::filesystem::directory_iterator(folder_.path() / name)->path().filename();
  };
  EXPECT_EQ(only_file("flow"), only_file("stop"));
}

TEST_F(AfterFailure, a_flow_that_was_stopped_is_resumed_to_the_same_bits) {
  take_run(folder_, "whole.h5", smaller_bed);
  write_file(folder_, "bed.toml", smaller_bed);
  // Each part ends with the first frame that it commits, however long that takes.
  int stops_in_flow = 0;
  for (int stops = 0; stops < 200; ++stops) {
    const pid_t process = folder_.start({"run", "bed.toml", "-o", "parts.h5", "--resume"});
    wait_for_commit(process, "parts.h5");
    kill(process, SIGTERM);
    if (wait_for(process) == 0) break;
    if (info("parts.h5", "theta_c_deg") != "null") ++stops_in_flow;
  }
  EXPECT_GT(stops_in_flow, 0) << "the flow was never interrupted, so nothing was tested";
  ASSERT_EQ(talus({"run", "--resume", "parts.h5"}).exit_code, 0);
  for (const char* key : {"state_hash", "theta_r", "frames", "frames_after_failure", "steps"})
    EXPECT_EQ(info("parts.h5", key), info("whole.h5", key)) << key;
}

}  // namespace
}  // namespace talus::test
