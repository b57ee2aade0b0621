/// Studies of a tiny bed: their runs, tables, interruption and resumption.

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <thread>

#include "support/process.h"
#include "support/runs.h"

namespace talus::test {
namespace {

/// Bed of 32 grains that is deposited and fully tilted in a fraction of a second.
const char* const tiny_bed =
    "[bed]\nlength = 10\ndepth = 4\n[tilt]\nend_angle = 1.5\n[output]\nframe_every = 0.5\n";

std::vector<std::string> study_of(const std::string& folder) {
  return {"study",   "bed.toml",
          "--vary",  "tilt.rate:tilt.step=2:0.002",
          "--vary",  "solver.tolerance=1e-5",
          "--seeds", "1-2",
          "-o",      folder};
}
/// Some of its runs, with the arguments of `talus run` that produce the same.
const std::pair<const char*, std::vector<std::string>> runs[] = {
    {"baseline/seed-1", {}},
    {"baseline/seed-2", {"--seed", "2"}},
    {"tilt.rate=2,tilt.step=0.002/seed-1", {"--set", "tilt.rate=2", "--set", "tilt.step=0.002"}},
    {"solver.tolerance=1e-05/seed-2", {"--seed", "2", "--set", "solver.tolerance=1e-5"}}};

std::string hash_of(const std::string& run, const TemporaryFolder& folder) {
  return json_value(run_talus({"info", run, "--json"}, folder.path()).out, "state_hash");
}

TEST(Study, runs_have_the_bits_of_talus_run) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  const Outcome study = run_talus(study_of("study"), folder.path());
  ASSERT_EQ(study.exit_code, 0) << study.err;
  for (const auto& [run, arguments] : runs)
    EXPECT_EQ(hash_of(std::string("study/") + run + ".h5", folder),
              hash_of(kept_run(tiny_bed, arguments).string(), folder))
        << run;
  EXPECT_NE(hash_of("study/baseline/seed-1.h5", folder), hash_of("study/baseline/seed-2.h5", folder));
}

TEST(Study, leaves_tables_and_prints_them) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  const Outcome study = run_talus(study_of("study"), folder.path());
  ASSERT_EQ(study.exit_code, 0) << study.err;
  const std::string tables = text_of(folder.path("study/study.md"));
  EXPECT_EQ(study.out, tables + "\n");
  for (const char* part : {"6 of 6 runs complete", "| baseline ", "| solver.tolerance=1e-05 ", "at 1.5 deg",
                           "within error", "comparisons differ"})
    EXPECT_NE(tables.find(part), std::string::npos) << part << "\n" << tables;
  const std::string rows = text_of(folder.path("study/study.csv"));
  EXPECT_EQ(std::ranges::count(rows, '\n'), 7) << rows;
  EXPECT_NE(rows.find(hash_of("study/baseline/seed-1.h5", folder)), std::string::npos);
}

TEST(Study, has_names_of_files_as_text_and_not_as_html) {
  const TemporaryFolder folder;
  const std::string name = "<img src=x>&[a](b)|`c`.toml";
  write_file(folder, name, tiny_bed);
  const Outcome study =
      run_talus({"study", name, "--seeds", "1", "--set", "tilt.end_angle=0.5", "-o", "study"}, folder.path());
  ASSERT_EQ(study.exit_code, 0) << study.err;
  const std::string tables = text_of(folder.path("study/study.md"));
  EXPECT_EQ(tables.find("# Study of &lt;img src=x>&amp;\\[a\\](b)\\|\\`c\\`.toml\n"), 0u) << tables;
}

TEST(Study, that_is_complete_is_only_read) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(study_of("study"), folder.path()).exit_code, 0);
  const auto written = std::filesystem::last_write_time(folder.path("study/baseline/seed-1.h5"));
  std::vector<std::string> again = study_of("study");
  again.insert(again.end(), {"--json", "--reference", "1"});
  const Outcome study = run_talus(again, folder.path());
  ASSERT_EQ(study.exit_code, 0) << study.err;
  EXPECT_EQ(study.err, "");
  EXPECT_EQ(json_value(study.out, "reference_deg"), "1");
  EXPECT_EQ(json_value(study.out, "verdict"), "unknown") << "theta_c of slopes that have not failed";
  EXPECT_EQ(std::filesystem::last_write_time(folder.path("study/baseline/seed-1.h5")), written);
}

class InterruptedStudy : public testing::TestWithParam<int> {};

TEST_P(InterruptedStudy, goes_on_to_the_same_bits) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  const std::vector<int> codes = stop_until_done(
      [&] { return start_talus(study_of("parts"), folder.path()); }, GetParam(), 50, folder.path("parts"));
  // The signal may arrive before the program handles it.
  for (const int code : codes)
    EXPECT_TRUE(code == 0 || code == -1 || (code == 75 && GetParam() != SIGKILL))
        << code << errors_in(folder.path());
  EXPECT_EQ(codes.back(), 0);
  for (const auto& [run, arguments] : runs)
    EXPECT_EQ(hash_of(std::string("parts/") + run + ".h5", folder),
              hash_of(kept_run(tiny_bed, arguments).string(), folder))
        << run;
}

INSTANTIATE_TEST_SUITE_P(Signals, InterruptedStudy, testing::Values(SIGINT, SIGTERM, SIGKILL));

/// Starts a study of one run that would take a minute, and returns once the run has committed something.
pid_t start_long_study(const TemporaryFolder& folder) {
  write_file(folder, "long.toml", "[bed]\nlength = 50\ndepth = 20\n[output]\ncheckpoint_every = 0\n");
  const std::string manifest = folder.path("long/baseline/seed-1.h5.run/manifest");
  std::error_code none;  // for a study that has not begun
  const auto before = std::filesystem::last_write_time(manifest, none);
  const pid_t process =
      start_talus({"study", "long.toml", "--seeds", "1", "-o", "long", "--jobs", "1"}, folder.path());
  for (int wait = 0; wait < 1000 && std::filesystem::last_write_time(manifest, none) == before; ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return process;
}

int steps_of_long_run(const TemporaryFolder& folder) {
  return std::stoi(
      std::string("0") +
      json_value(run_talus({"info", "long/baseline/seed-1.h5", "--json"}, folder.path()).out, "steps"));
}

TEST(Study, that_is_stopped_stops_its_runs_and_goes_on_where_they_were) {
  const TemporaryFolder folder;
  const pid_t first = start_long_study(folder);
  for (int wait = 0; wait < 1000 && steps_of_long_run(folder) < 10; ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const auto asked = std::chrono::steady_clock::now();
  kill(first, SIGTERM);
  EXPECT_EQ(wait_for(first), 75);
  ASSERT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds(10));
  const int steps = steps_of_long_run(folder);
  EXPECT_GT(steps, 1);
  const pid_t second = start_long_study(folder);
  kill(second, SIGTERM);
  EXPECT_EQ(wait_for(second), 75);
  EXPECT_GE(steps_of_long_run(folder), steps);
}

TEST(Study, that_is_killed_leaves_no_run_behind) {
  const TemporaryFolder folder;
  const pid_t study = start_long_study(folder);
  std::ifstream lock(folder.path("long/baseline/seed-1.h5.run/lock"));
  std::string word, writer;
  lock >> word >> writer;  // "process 123 on host ..."
  const std::string its_arguments = std::string("/proc/").append(writer).append("/cmdline");
  ASSERT_FALSE(text_of(its_arguments).empty()) << "process '" << writer << "'";
  kill(study, SIGKILL);
  wait_for(study);
  for (int wait = 0; wait < 1000 && !text_of(its_arguments).empty(); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(text_of(its_arguments), "");
}

TEST(Study, with_a_bad_key_leaves_with_65_before_anything_runs) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  for (const char* axis : {"tilt.stp=0.002", "tilt.step=0.002,-1"}) {
    const Outcome study = run_talus({"study", "bed.toml", "--vary", axis, "-o", "study"}, folder.path());
    EXPECT_EQ(study.exit_code, 65) << axis;
    EXPECT_NE(study.err.find("--vary tilt.st"), std::string::npos) << study.err;
    EXPECT_EQ(study.err.find("--set"), std::string::npos) << study.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path("study")));
}

TEST(Study, of_a_bad_form_leaves_with_64) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  EXPECT_EQ(run_talus({"study", "bed.toml"}, folder.path()).exit_code, 64) << "not a folder";
  EXPECT_EQ(run_talus({"study", "bed.toml", "--vary", "tilt.step", "-o", "s"}, folder.path()).exit_code, 64);
  EXPECT_EQ(run_talus({"study", "bed.toml", "--seeds", "4-1", "-o", "s"}, folder.path()).exit_code, 64);
}

TEST(Study, does_not_mix_scenarios_in_a_folder) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus({"study", "bed.toml", "--seeds", "1", "-o", "study"}, folder.path()).exit_code, 0);
  const Outcome other = run_talus(
      {"study", "bed.toml", "--seeds", "1", "-o", "study", "--set", "contact.friction=0.3"}, folder.path());
  EXPECT_EQ(other.exit_code, 65);
  EXPECT_NE(other.err.find("contact.friction is 0.5 there, 0.3 here"), std::string::npos) << other.err;
}

TEST(Study, takes_runs_that_are_there_and_no_run_of_another_scenario) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  std::filesystem::create_directories(folder.path("study/baseline"));
  const std::string run = "study/baseline/seed-1.h5";
  take_run(folder, run, tiny_bed, {"--seed", "1"});
  const Outcome other = run_talus(
      {"study", "bed.toml", "--seeds", "1", "-o", "study", "--set", "contact.friction=0.3"}, folder.path());
  EXPECT_EQ(other.exit_code, 65);
  EXPECT_NE(other.err.find(run), std::string::npos) << other.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("study/ensemble.manifest"))) << "nothing has begun";
  const std::string before = hash_of(run, folder);
  const Outcome study = run_talus({"study", "bed.toml", "--seeds", "1", "-o", "study"}, folder.path());
  EXPECT_EQ(study.exit_code, 0) << study.err;
  EXPECT_EQ(hash_of(run, folder), before);
  EXPECT_EQ(text_of(folder.path("study/baseline/seed-1.log")).find("deposition"), std::string::npos);
}

TEST(Study, is_an_ensemble_that_others_may_compute) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  std::vector<std::string> begin = study_of("study");
  begin.insert(begin.end(), {"--jobs", "0"});
  const Outcome begun = run_talus(begin, folder.path());
  EXPECT_EQ(begun.exit_code, 0) << begun.err;
  EXPECT_NE(begun.out.find("study: 0 of 6 done"), std::string::npos) << begun.out;
  EXPECT_FALSE(std::filesystem::exists(folder.path("study/study.md")));
  ASSERT_EQ(run_talus({"ensemble", "work", "study"}, folder.path()).exit_code, 0);
  const Outcome status = run_talus({"ensemble", "status", "study"}, folder.path());
  EXPECT_NE(status.out.find("study: 6 of 6 done"), std::string::npos) << status.out;
  const Outcome study = run_talus(begin, folder.path());
  EXPECT_EQ(study.exit_code, 0) << study.err;
  EXPECT_NE(study.out.find("6 of 6 runs complete"), std::string::npos) << study.out;
  const std::string members = text_of(folder.path("study/members.csv"));
  EXPECT_EQ(std::ranges::count(members, '\n'), 7) << members;
}

TEST(Study, compares_what_is_complete_where_a_run_fails) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  const Outcome study =
      run_talus({"study", "bed.toml", "--vary", "deposition.max_time=0.05", "--seeds", "1", "-o", "study"},
                folder.path());
  EXPECT_EQ(study.exit_code, 65);
  EXPECT_NE(study.err.find("deposition.max_time=0.05/seed-1.log"), std::string::npos) << study.err;
  EXPECT_NE(text_of(folder.path("study/deposition.max_time=0.05/seed-1.log")).find("did not come to rest"),
            std::string::npos);
  EXPECT_NE(study.out.find("1 of 2 runs complete"), std::string::npos) << study.out;
  const Outcome status = run_talus({"ensemble", "status", "study"}, folder.path());
  EXPECT_NE(status.out.find("failed: deposition.max_time=0.05/seed-1, exit code 65"), std::string::npos)
      << status.out;
}

}  // namespace
}  // namespace talus::test
