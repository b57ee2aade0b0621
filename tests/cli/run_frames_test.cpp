/// Maps drawn while a run computes, which must not affect the run.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "pictures.h"
#include "support/process.h"
#include "support/runs.h"

namespace talus::test {
namespace {

namespace fs = std::filesystem;

/// Bed that is tilted fast, so that it fails and flows within a few seconds.
const char* const failing_bed =
    "seed = 2\n[bed]\nlength = 20\ndepth = 6\n[deposition]\nrest_velocity = 0.05\n"
    "[tilt]\nrate = 20\nstep = 0.02\nafter_failure = \"lower\"\nlowering_rate = 20\n"
    "[output]\nframe_every = 1\nobservable_every = 0.2\n";

class RunFrames : public testing::Test {
 protected:
  RunFrames() { write_file(folder_, "bed.toml", failing_bed); }

  Outcome talus(const std::vector<std::string>& arguments) { return run_talus(arguments, folder_.path()); }
  std::string info(const std::string& run, const std::string& key) {
    return json_value(talus({"info", run, "--json"}).out, key);
  }

  TemporaryFolder folder_;
  const std::vector<std::string> maps_ = {"--map", "clusters,displacement", "--width", "400"};
  std::vector<std::string> run(const std::string& output, const std::string& maps,
                               const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"run", "bed.toml", "-o", output, "--pictures", maps};
    arguments.insert(arguments.end(), maps_.begin(), maps_.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
};

TEST_F(RunFrames, do_not_change_the_run) {
  take_run(folder_, "plain.h5", failing_bed);
  const Outcome drawn = talus(run("drawn.h5", "maps"));
  ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
  EXPECT_NE(drawn.err.find("20 deg; --theta-c"), std::string::npos) << drawn.err;
  EXPECT_EQ(info("drawn.h5", "state_hash"), info("plain.h5", "state_hash"));
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
  const std::vector<std::string> few = {"--resume", "--set", "output.frame_every=4"};
  ASSERT_EQ(talus(run("whole.h5", "whole", few)).exit_code, 0);
  int stops = 0;
  for (int attempt = 0; attempt < 40; ++attempt) {
    const pid_t process = start_talus(run("parts.h5", "parts", few), folder_.path());
    pause_before(attempt, 150);
    kill(process, attempt % 2 == 0 ? SIGTERM : SIGKILL);
    const int code = wait_for(process);
    ASSERT_TRUE(code == 0 || code == 75 || code == -1) << code;
    if (code == 0) break;
    if (!names_in(folder_.path() / "parts").empty()) ++stops;
  }
  EXPECT_GT(stops, 0) << "it was never interrupted while drawing, so nothing was tested";
  const Outcome last = talus(run("parts.h5", "parts", few));
  ASSERT_EQ(last.exit_code, 0) << last.err;
  EXPECT_EQ(info("parts.h5", "state_hash"), info("whole.h5", "state_hash"));
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
  const Outcome again = talus(run("whole.h5", "whole", {"--resume"}));
  EXPECT_EQ(again.exit_code, 0) << again.err;
  ASSERT_EQ(names_in(folder_.path() / "whole"), names);
  EXPECT_EQ(pixels_of(last), pixels);
}

TEST_F(RunFrames, that_cannot_be_written_do_not_lose_the_run) {
  take_run(folder_, "plain.h5", failing_bed);
  fs::create_directories(folder_.path() / "maps/clusters_005.00.png/x");  // prevents a file of that name
  const Outcome outcome = talus(run("bed.h5", "maps", {"--overwrite"}));
  EXPECT_EQ(outcome.exit_code, 73);
  EXPECT_NE(outcome.err.find("warning"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("the run is complete, but its maps in maps are not"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(info("bed.h5", "state_hash"), info("plain.h5", "state_hash"));
  EXPECT_EQ(info("bed.h5", "complete"), "true");
}

TEST_F(RunFrames, refuse_before_anything_is_computed) {
  fs::create_directory(folder_.path() / "maps");
  write_file(folder_, "maps/clusters_000.00.png", "precious");
  const Outcome there = talus(run("bed.h5", "maps"));
  EXPECT_EQ(there.exit_code, 73);
  EXPECT_NE(there.err.find("pictures of the map clusters"), std::string::npos) << there.err;
  write_file(folder_, "file", "");
  EXPECT_EQ(talus(run("bed.h5", "file/maps")).exit_code, 73);
  EXPECT_FALSE(fs::exists(folder_.path() / "bed.h5.run"));
  EXPECT_EQ(file_bytes(folder_.path() / "maps/clusters_000.00.png"), "precious");
}

TEST_F(RunFrames, of_the_flow_are_drawn_from_the_file_too) {
  take_run(folder_, "bed.h5", failing_bed);
  const Outcome outcome = talus(
      {"render", "bed.h5", "--map", "clusters", "--every", "1", "--flow", "--width", "400", "-o", "maps"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::set<std::string> names = names_in(folder_.path() / "maps");
  const auto flow = std::ranges::count_if(
      names, [](const std::string& name) { return name.starts_with("clusters_flow_"); });
  EXPECT_EQ(flow, std::stoi(info("bed.h5", "frames_after_failure")));
  EXPECT_TRUE(std::prev(names.end())->starts_with("clusters_flow_"));
}

}  // namespace
}  // namespace talus::test
