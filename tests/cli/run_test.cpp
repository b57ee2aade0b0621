/// Complete runs of a small bed: outputs, interruptions, resumption, bit-identical results.

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include "io/run_file.h"
#include "support/process.h"
#include "support/runs.h"

namespace talus::test {
namespace {

/// Bed that is deposited and fully tilted in about a second.
const char* const small_bed =
    "seed = 3\n[bed]\nlength = 16\ndepth = 6\n[tilt]\nend_angle = 3.0\n[output]\nframe_every = 0.5\n";

std::string hash_of(const std::string& run, const TemporaryFolder& folder) {
  const Outcome outcome = run_talus({"info", run, "--json"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return json_value(outcome.out, "state_hash");
}

TEST(Run, leaves_one_file_that_tells_what_it_holds) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  const Outcome run = run_talus({"run", "bed.toml", "-o", "bed.h5"}, folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "bed.h5"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "bed.h5.run"));
  const std::string json = run_talus({"info", "bed.h5", "--json"}, folder.path()).out;
  EXPECT_EQ(json_value(json, "seed"), "3");
  EXPECT_EQ(json_value(json, "grains"), "96");
  EXPECT_EQ(json_value(json, "frames"), "7") << "0, 0.5, ... 3 deg";
  EXPECT_EQ(json_value(json, "complete"), "true");
  EXPECT_EQ(json_value(json, "theta_c_deg"), "null") << "this bed is stable at 3 deg";
  EXPECT_EQ(json_value(json, "state_hash").size(), 16u);
}

TEST(Run, quiet_prints_nothing_but_warnings) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  const Outcome run = run_talus({"run", "bed.toml", "--quiet"}, folder.path());
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.out, "");
  EXPECT_TRUE(run.err.empty() || run.err.find("warning") != std::string::npos) << run.err;
}

TEST(Run, existing_output_is_refused_unless_told) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  write_file(folder, "bed.h5", "precious");
  const Outcome refused = run_talus({"run", "bed.toml", "-o", "bed.h5"}, folder.path());
  EXPECT_EQ(refused.exit_code, 73);
  EXPECT_NE(refused.err.find("--overwrite"), std::string::npos) << refused.err;
  std::ifstream file(folder.path() / "bed.h5");
  std::string kept;
  std::getline(file, kept);
  EXPECT_EQ(kept, "precious");
}

TEST(Run, same_bits_for_any_number_of_threads) {
  const TemporaryFolder folder;
  // Large enough for two threads to share its contacts.
  write_file(folder, "bed.toml",
             "[bed]\nlength = 60\ndepth = 20\n[deposition]\nmethod = \"collapse\"\nrest_velocity = 0.1\n"
             "[tilt]\nend_angle = 0.05\n");
  ASSERT_EQ(run_talus({"run", "bed.toml", "-o", "one.h5", "--threads", "1"}, folder.path()).exit_code, 0);
  ASSERT_EQ(run_talus({"run", "bed.toml", "-o", "two.h5", "--threads", "2"}, folder.path()).exit_code, 0);
  EXPECT_EQ(hash_of("one.h5", folder), hash_of("two.h5", folder));
}

TEST(Run, another_seed_is_another_bed) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  ASSERT_EQ(
      run_talus({"run", "bed.toml", "-o", "a.h5", "--set", "tilt.end_angle=0.5"}, folder.path()).exit_code,
      0);
  ASSERT_EQ(run_talus({"run", "bed.toml", "-o", "b.h5", "--seed", "4", "--set", "tilt.end_angle=0.5"},
                      folder.path())
                .exit_code,
            0);
  EXPECT_NE(hash_of("a.h5", folder), hash_of("b.h5", folder));
}

/// Returns everything in a packed run except its provenance, which records when and how it was made.
std::string science_of(const std::string& run, const TemporaryFolder& folder) {
  const std::string script =
      "import h5py,sys,hashlib\n"
      "h=hashlib.sha256()\n"
      "def visit(name,item):\n"
      "    if isinstance(item,h5py.Dataset) and not name.startswith('provenance'):\n"
      "        h.update(name.encode()); h.update(item[()].tobytes() if hasattr(item[()],'tobytes') else "
      "bytes(item[()]))\n"
      "h5py.File(sys.argv[1],'r').visititems(visit)\n"
      "print(h.hexdigest())\n";
  write_file(folder, "science.py", script);
  const std::filesystem::path out = folder.path() / "science.txt";
  const std::string command = "/usr/bin/python3 " + (folder.path() / "science.py").string() + " " +
                              (folder.path() / run).string() + " > " + out.string() + " 2> /dev/null";
  if (std::system(command.c_str()) != 0) return {};
  std::ifstream file(out);
  std::string digest;
  file >> digest;
  return digest;
}

class Interrupted : public testing::TestWithParam<int> {};

TEST_P(Interrupted, run_resumes_to_the_same_bits) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  take_run(folder, "whole.h5", small_bed);
  const std::vector<std::string> words = {"run", "bed.toml", "-o", "parts.h5", "--resume"};
  const std::vector<int> codes = stop_until_done([&] { return start_talus(words, folder.path()); },
                                                 GetParam(), 60, folder.path("parts.h5"));
  // The signal may arrive before the run handles it.
  for (const int code : codes)
    EXPECT_TRUE(code == 0 || code == -1 || (code == 75 && GetParam() != SIGKILL)) << code;
  ASSERT_EQ(run_talus({"run", "bed.toml", "-o", "parts.h5", "--resume"}, folder.path()).exit_code, 0);
  EXPECT_EQ(hash_of("parts.h5", folder), hash_of("whole.h5", folder));
  const std::string whole = science_of("whole.h5", folder);
  if (whole.empty()) GTEST_SKIP() << "python3-h5py is not installed: data sets were not compared";
  EXPECT_EQ(science_of("parts.h5", folder), whole);
}

INSTANTIATE_TEST_SUITE_P(Signals, Interrupted, testing::Values(SIGINT, SIGTERM, SIGKILL));

/// Starts a run that would take a minute, and returns once it has committed something.
pid_t start_long_run(const TemporaryFolder& folder) {
  write_file(folder, "bed.toml", "[bed]\nlength = 50\ndepth = 20\n[output]\ncheckpoint_every = 0\n");
  const pid_t process = start_talus({"run", "bed.toml", "-o", "bed.h5"}, folder.path());
  for (int wait = 0; wait < 1000 && !std::filesystem::exists(folder.path("bed.h5.run/manifest")); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(std::filesystem::exists(folder.path("bed.h5.run/manifest")));
  return process;
}

TEST(Run, a_second_writer_is_refused) {
  const TemporaryFolder folder;
  const pid_t first = start_long_run(folder);
  const Outcome second = run_talus({"run", "bed.toml", "-o", "bed.h5", "--resume"}, folder.path());
  EXPECT_EQ(second.exit_code, 73) << second.err;
  EXPECT_NE(second.err.find(std::to_string(first)), std::string::npos) << second.err;
  kill(first, SIGKILL);
  wait_for(first);
}

TEST(Run, is_resumed_by_its_name_or_its_folder_alone) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  for (const char* name : {"bed.h5", "./bed.h5.run/"}) {
    SCOPED_TRACE(name);
    const Outcome begun = run_talus({"run", "bed.toml", "--max-wall", "00:00:01", "--set", "seed=3", "--set",
                                     "output.checkpoint_every=0", "--set", "tilt.end_angle=60"},
                                    folder.path());
    ASSERT_EQ(begun.exit_code, 75) << begun.err;
    EXPECT_NE(begun.err.find("; talus run --resume bed.h5 continues.\n"), std::string::npos) << begun.err;
    const Outcome again = run_talus({"run", "--resume", name, "--max-wall", "00:00:01"}, folder.path());
    EXPECT_EQ(again.exit_code, 75) << again.err;
    EXPECT_EQ(again.err.find("was started by version"), std::string::npos) << again.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path("bed.h5")));
    std::filesystem::remove_all(folder.path("bed.h5.run"));
  }
}

TEST(Run, that_cannot_be_resumed_says_why) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  const auto resume = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"run", "--resume"});
    return run_talus(words, folder.path());
  };
  const Outcome nothing = resume({"bed.h5"});
  EXPECT_EQ(nothing.exit_code, 66);
  EXPECT_NE(nothing.err.find("start it with: talus run SCENARIO -o bed.h5"), std::string::npos)
      << nothing.err;
  write_file(folder, "text.h5", "precious");
  EXPECT_EQ(resume({"text.h5"}).exit_code, 65);
  EXPECT_EQ(resume({"bed.h5", "--seed", "4"}).exit_code, 64);
  EXPECT_EQ(run_talus({"run", "bed.toml", "--max-wall", "90"}, folder.path()).exit_code, 64);
  EXPECT_FALSE(std::filesystem::exists(folder.path("bed.h5.run")));
}

TEST(Run, that_is_complete_has_nothing_to_resume_but_a_folder_left_behind) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  ASSERT_EQ(run_talus({"run", "bed.toml", "--set", "tilt.end_angle=0.5"}, folder.path()).exit_code, 0);
  std::filesystem::create_directory(folder.path("bed.h5.run"));
  write_file(folder, "bed.h5.run/segment_000001.h5", "left by a kill");
  const Outcome outcome = run_talus({"run", "--resume", "bed.h5"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "bed.h5 is already complete.\n");
  EXPECT_FALSE(std::filesystem::exists(folder.path("bed.h5.run")));
}

// A batch system sends its signal to the script of a job and to all its processes, and the script passes it
// on.
TEST(Run, commits_a_checkpoint_even_if_a_signal_comes_twice) {
  const TemporaryFolder folder;
  const pid_t process = start_long_run(folder);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // computes some steps
  kill(process, SIGTERM);
  kill(process, SIGINT);
  ASSERT_EQ(wait_for(process), 75);
  EXPECT_GT(io::RunFile::open(folder.path("bed.h5")).checkpoint().world.step, 0);
}

TEST(Run, replaces_no_file_that_has_appeared_under_its_name) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  const pid_t process = start_talus({"run", "bed.toml", "-o", "bed.h5"}, folder.path());
  while (!has_ended(process) && !std::filesystem::exists(folder.path("bed.h5.run/manifest")))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  write_file(folder, "bed.h5", "precious");
  EXPECT_EQ(wait_for(process), 73);
  EXPECT_NE(errors_in(folder.path())
                .find("bed.h5 was created by another process in the meantime, and is kept; the "
                      "run is in bed.h5.run: move the file away, and complete the run with talus "
                      "run --resume bed.h5"),
            std::string::npos)
      << errors_in(folder.path());
  EXPECT_EQ(text_of(folder.path("bed.h5")), "precious");
  EXPECT_EQ(run_talus({"info", "bed.h5"}, folder.path()).exit_code, 0) << "the run in the folder";
  EXPECT_EQ(run_talus({"run", "--resume", "bed.h5"}, folder.path()).exit_code, 73);
  EXPECT_EQ(text_of(folder.path("bed.h5")), "precious");
  std::filesystem::rename(folder.path("bed.h5"), folder.path("moved"));
  EXPECT_EQ(run_talus({"run", "--resume", "bed.h5"}, folder.path()).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder.path("bed.h5.run")));
  // The run of another name that appears is not removed either, and does not hide the folder once packing has
  // failed.
  const std::string other = text_of(folder.path("bed.h5"));
  const pid_t again = start_talus({"run", "bed.toml", "-o", "new.h5", "--seed", "4"}, folder.path());
  while (!has_ended(again) && !std::filesystem::exists(folder.path("new.h5.run/manifest")))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  std::filesystem::copy_file(folder.path("bed.h5"), folder.path("new.h5"));
  EXPECT_EQ(wait_for(again), 73);
  EXPECT_EQ(text_of(folder.path("new.h5")), other);
  EXPECT_EQ(json_value(run_talus({"info", "new.h5", "--json"}, folder.path()).out, "seed"), "4");
}

TEST(Run, of_a_bed_that_cannot_be_stored_is_refused_before_its_first_step) {
  const TemporaryFolder folder;
  std::string table = "x,y,radius\n";
  for (int k = 0; k < 30; ++k)
    table += std::to_string(k % 10) + ".5," + std::to_string(0.51 + 1.02 * (k / 10)) + ",0.5\n";
  write_file(folder, "bed.toml",
             "[bed]\nlength = 10\ndepth = 3\n[deposition]\nmethod = \"file\"\nfile = "
             "\"bed.csv\"\nrest_velocity = 0.1\n"
             "[tilt]\nrate = 20\nstep = 0.01\nend_angle = 0.1\n");
  for (const auto& [last, message] :
       {std::pair{"1,1.02,0.0009\n",
                  "bed.csv:32:1: error: the grain has a radius of 0.0009 D: "
                  "expected 0.001 to 1000 D"},
        {"1,1.02,1e-300\n", "bed.csv:32:1: error: the grain has a radius of 1e-300 D"},
        {"1,130001,0.5\n",
         "bed.csv:32:1: error: the grain is at x = 1 D, y = 130001 D: "
         "expected at most 130000 D from the origin"}}) {
    write_file(folder, "bed.csv", table + last);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"check", "bed.toml"}, {"run", "bed.toml"}}) {
      const Outcome outcome = run_talus(words, folder.path());
      EXPECT_EQ(outcome.exit_code, 65) << outcome.err;
      EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
    }
    EXPECT_FALSE(std::filesystem::exists(folder.path("bed.h5.run")));
  }
}

TEST(Run, another_scenario_cannot_resume_it) {
  const TemporaryFolder folder;
  const pid_t process = start_long_run(folder);
  kill(process, SIGTERM);
  ASSERT_EQ(wait_for(process), 75);
  const Outcome outcome = run_talus(
      {"run", "bed.toml", "-o", "bed.h5", "--resume", "--set", "contact.friction=0.3"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 65) << outcome.err;
}

// In a loop over a parameter that gives every run the same name, the first run must not be accepted for all.
TEST(Run, of_another_scenario_is_not_taken_for_the_one_asked_for) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", small_bed);
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.begin(),
                 {"run", "bed.toml", "-o", "bed.h5", "--resume", "--set", "tilt.end_angle=0.5"});
    return run_talus(words, folder.path());
  };
  ASSERT_EQ(run({}).exit_code, 0);
  EXPECT_EQ(run({}).exit_code, 0);
  const Outcome other = run({"--set", "contact.friction=0.3", "--seed", "77"});
  EXPECT_EQ(other.exit_code, 65);
  EXPECT_NE(other.err.find("contact.friction is 0.5 there, 0.3 here"), std::string::npos) << other.err;
  EXPECT_NE(other.err.find("77 here"), std::string::npos) << other.err;
  EXPECT_EQ(run_talus({"run", "none.toml", "-o", "bed.h5", "--resume"}, folder.path()).exit_code, 66);
}

TEST(Run, maps_are_drawn_from_the_file) {
  const TemporaryFolder folder;
  take_run(folder, "bed.h5", small_bed);
  const Outcome refused = run_talus({"render", "bed.h5", "--map", "overloaded", "-o", "maps"}, folder.path());
  EXPECT_EQ(refused.exit_code, 65) << "this bed did not fail, so Gamma_c is unknown";
  const Outcome outcome = run_talus(
      {"render", "bed.h5", "--map", "gamma,overloaded", "--theta-c", "20", "--at", "0,2", "-o", "maps"},
      folder.path());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* name :
       {"gamma_000.00.png", "gamma_002.00.png", "overloaded_000.00.png", "overloaded_002.00.png"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "maps" / name)) << name;
}

}  // namespace
}  // namespace talus::test
