/// Runs that continue after failure: their reports, and their files in other commands.

#include <gtest/gtest.h>

#include <csignal>
#include <map>
#include <sstream>
#include <thread>

#include "core/trigonometry.h"
#include "support/process.h"
#include "support/runs.h"

namespace talus::test {
namespace {

/// Small bed that is tilted fast: it fails and comes to rest again within a few seconds.
const char* const lowered_bed =
    "seed = 2\n[bed]\nlength = 20\ndepth = 6\n[deposition]\nrest_velocity = 0.05\n"
    "[tilt]\nrate = 20\nstep = 0.02\nafter_failure = \"lower\"\nlowering_rate = 5\n"
    "[output]\nframe_every = 1\nobservable_every = 0.2\n";

/// Bed of 40 grains with few frames.
const char* const smaller_bed =
    "seed = 2\n[bed]\nlength = 10\ndepth = 4\n[deposition]\nrest_velocity = 0.05\n"
    "[tilt]\nrate = 20\nstep = 0.02\nafter_failure = \"lower\"\nlowering_rate = 5\n"
    "[output]\nframe_every = 5\nobservable_every = 0.2\n";

class AfterFailure : public testing::Test {
 protected:
  AfterFailure() { write_file(folder_, "bed.toml", lowered_bed); }

  Outcome talus(const std::vector<std::string>& arguments) { return run_talus(arguments, folder_.path()); }
  std::string info(const std::string& run, const std::string& key) {
    return json_value(talus({"info", run, "--json"}).out, key);
  }

  /// Waits until the process that writes the run commits again or ends.
  void wait_for_commit(pid_t process, const std::string& run) const {
    const auto committed = [&] {
      std::error_code none;  // for a run that has not begun
      return std::filesystem::last_write_time(folder_.path(run + ".run/manifest"), none);
    };
    const auto before = committed();
    for (int wait = 0; wait < 6000 && committed() == before && !has_ended(process); ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }

  TemporaryFolder folder_;
};

TEST_F(AfterFailure, the_angle_at_rest_is_told) {
  const Outcome run = talus({"run", "bed.toml", "-o", "bed.h5"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("theta_r = "), std::string::npos) << run.out;
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
  const std::string text = talus({"info", "bed.h5"}).out;
  EXPECT_NE(text.find("theta_r"), std::string::npos) << text;
}

TEST_F(AfterFailure, a_flow_that_does_not_stop_is_told) {
  const Outcome run = talus({"run", "bed.toml", "-o", "bed.h5", "--set", "tilt.after_failure=hold", "--set",
                             "deposition.max_time=2"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("had not stopped"), std::string::npos) << run.out;
  EXPECT_EQ(info("bed.h5", "theta_r_deg"), "null");
}

TEST_F(AfterFailure, the_other_commands_see_the_tilt_alone) {
  take_run(folder_, "flow.h5", lowered_bed);
  take_run(folder_, "stop.h5", lowered_bed, {"--set", "tilt.after_failure=stop"});
  EXPECT_EQ(info("flow.h5", "frames"), info("stop.h5", "frames"));
  EXPECT_EQ(info("flow.h5", "theta_c_deg"), info("stop.h5", "theta_c_deg"));
  EXPECT_EQ(info("stop.h5", "theta_r_deg"), "null");
  EXPECT_EQ(talus({"info", "stop.h5"}).out.find("theta_r"), std::string::npos);
  const auto table = [this](const std::string& run) {
    const std::string text = talus({"analyze", run}).out;
    return text.substr(text.find('\n'));  // without the name
  };
  const std::string stopped = table("stop.h5");
  EXPECT_NE(stopped.find("theta_d by"), std::string::npos) << stopped;
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
    const pid_t process = start_talus({"run", "bed.toml", "-o", "parts.h5", "--resume"}, folder_.path());
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
