/// Ensembles of a tiny bed: workers that share a folder, interruptions, takeovers, failures, and reports.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <thread>

#include "base/descriptor.h"
#include "support/places.h"
#include "support/process.h"

namespace talus::test {
namespace {

/// Bed of 32 grains that is deposited and fully tilted in a fraction of a second.
const char* const tiny_bed =
    "[bed]\nlength = 10\ndepth = 4\n[tilt]\nend_angle = 1.5\n[output]\nframe_every = 0.5\n";

std::vector<std::string> ensemble_of(const std::string& folder, const std::string& seeds = "1-4") {
  return {"ensemble", "bed.toml", "--seeds", seeds, "-o", folder};
}

/// Returns the hash of the last state of a run.
std::string hash_in(const TemporaryFolder& folder, const std::string& run) {
  return json_value(run_talus({"info", run, "--json"}, folder.path()).out, "state_hash");
}

std::size_t count_of_lines(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

TEST(Ensemble, has_the_bits_of_talus_run_and_its_analysis) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  std::vector<std::string> words = ensemble_of("e", "1-2");
  words.insert(words.end(), {"--vary", "contact.friction=0.3,0.5"});
  const Outcome done = run_talus(words, folder.path());
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find("e: 4 of 4 done, 0 under way\n"), std::string::npos) << done.out;
  ASSERT_EQ(run_talus({"run", "bed.toml", "--seed", "2", "--set", "contact.friction=0.3", "-o", "alone.h5"},
                      folder.path())
                .exit_code,
            0);
  const std::string alone = hash_in(folder, "alone.h5");
  EXPECT_EQ(hash_in(folder, "e/contact.friction=0.3/seed-2.h5"), alone);
  EXPECT_NE(text_of(folder.path("e/members.csv")).find(",2," + alone + ","), std::string::npos);
  const Outcome analysis = run_talus({"analyze", "e/contact.friction=0.3/seed-2.h5"}, folder.path());
  EXPECT_NE((analysis.out + analysis.err).find("analysis read from the file"), std::string::npos)
      << analysis.out;
  EXPECT_EQ(count_of_lines(text_of(folder.path("e/members.csv"))), 5u);
}

TEST(Ensemble, that_is_complete_is_only_read_and_grows_by_seeds) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(ensemble_of("e", "1-2"), folder.path()).exit_code, 0);
  const auto written = std::filesystem::last_write_time(folder.path("e/seed-1.h5"));
  ASSERT_EQ(run_talus(ensemble_of("e", "1-2"), folder.path()).exit_code, 0);
  const Outcome more = run_talus(ensemble_of("e", "3"), folder.path());
  EXPECT_NE(more.out.find("3 of 3 done"), std::string::npos) << more.out;
  EXPECT_EQ(std::filesystem::last_write_time(folder.path("e/seed-1.h5")), written);
}

TEST(Ensemble, has_averages_over_tilt_that_do_not_depend_on_when_members_came) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(ensemble_of("at-once", "1-3"), folder.path()).exit_code, 0);
  for (const char* seeds : {"3", "1", "2"})
    ASSERT_EQ(run_talus(ensemble_of("one-by-one", seeds), folder.path()).exit_code, 0);
  EXPECT_EQ(text_of(folder.path("at-once/averages.csv")), text_of(folder.path("one-by-one/averages.csv")));
  EXPECT_EQ(text_of(folder.path("at-once/ensemble.h5")), text_of(folder.path("one-by-one/ensemble.h5")));
  EXPECT_NE(
      text_of(folder.path("at-once/averages.csv")).find("over_tilt,1.5,contacts/coordination_number,1,3,"),
      std::string::npos);
  if (std::system("/usr/bin/python3 -c 'import h5py' 2>/dev/null") != 0)
    GTEST_SKIP() << "python3-h5py is not installed";
  const std::string read = "cd " + folder.path().string() + " && /usr/bin/python3 " + source_folder() +
                           "/tests/cli/ensemble_with_h5py.py at-once/ensemble.h5 > read.txt 2>&1";
  EXPECT_EQ(std::system(read.c_str()), 0) << text_of(folder.path("read.txt"));
  EXPECT_EQ(text_of(folder.path("read.txt")), "1 2 3 0.0 0.5 1.0 1.5\n");
}

TEST(Ensemble, is_averaged_again_from_the_runs_of_its_members) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(ensemble_of("e", "1-2"), folder.path()).exit_code, 0);
  const std::string before = text_of(folder.path("e/averages.csv"));
  for (const char* name : {"e/averages.csv", "e/ensemble.h5", "e/members.csv"})
    std::filesystem::remove(folder.path(name));
  // Like the output of talus run: without an analysis.
  ASSERT_EQ(run_talus({"run", "bed.toml", "--seed", "2", "-o", "e/seed-2.h5", "--overwrite"}, folder.path())
                .exit_code,
            0);
  EXPECT_EQ(run_talus({"ensemble", "status", "e"}, folder.path()).exit_code, 0);
  const Outcome again = run_talus({"ensemble", "average", "e"}, folder.path());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(text_of(folder.path("e/averages.csv")), before);
  EXPECT_EQ(count_of_lines(text_of(folder.path("e/members.csv"))), 3u);
  EXPECT_TRUE(std::filesystem::exists(folder.path("e/ensemble.h5")));
  const std::string whole = text_of(folder.path("e/seed-1.h5"));
  write_file(folder, "e/seed-1.h5", whole.substr(0, whole.size() / 2));
  const Outcome changed = run_talus({"ensemble", "average", "e"}, folder.path());
  EXPECT_EQ(changed.exit_code, 65);
  EXPECT_NE(changed.err.find("e/seed-1.h5: is damaged"), std::string::npos) << changed.err;
  std::filesystem::remove(folder.path("e/seed-1.h5"));
  EXPECT_EQ(run_talus(ensemble_of("e", "1-2"), folder.path()).exit_code, 0) << "it is computed again";
}

TEST(Ensemble, is_averaged_by_one_process_at_a_time_and_none_is_refused) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(ensemble_of("e", "1-3"), folder.path()).exit_code, 0);
  const std::string before = text_of(folder.path("e/averages.csv"));
  for (int round = 0; round < 5; ++round) {
    std::vector<pid_t> processes;
    for (int k = 0; k < 6; ++k) processes.push_back(start_talus({"ensemble", "average", "e"}, folder.path()));
    for (const pid_t process : processes) EXPECT_EQ(wait_for(process), 0) << errors_in(folder.path());
  }
  EXPECT_EQ(text_of(folder.path("e/averages.csv")), before);
  EXPECT_FALSE(std::filesystem::exists(folder.path("e/averages.lock")));
  EXPECT_EQ(run_talus({"ensemble", "average", "none"}, folder.path()).exit_code, 66);
  EXPECT_FALSE(std::filesystem::exists(folder.path("none")));
}

class InterruptedEnsemble : public testing::TestWithParam<int> {};

TEST_P(InterruptedEnsemble, goes_on_to_the_same_bits) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(ensemble_of("whole"), folder.path()).exit_code, 0);
  const std::vector<int> codes = stop_until_done(
      [&] { return start_talus(ensemble_of("parts"), folder.path()); }, GetParam(), 50, folder.path("parts"));
  for (const int code : codes)
    EXPECT_TRUE(code == 0 || code == -1 || code == 75) << code << errors_in(folder.path());
  EXPECT_EQ(codes.back(), 0);
  for (const char* member : {"seed-1.h5", "seed-2.h5", "seed-3.h5", "seed-4.h5"})
    EXPECT_EQ(hash_in(folder, std::string("parts/") + member),
              hash_in(folder, std::string("whole/") + member))
        << member;
  EXPECT_EQ(text_of(folder.path("parts/averages.csv")), text_of(folder.path("whole/averages.csv")));
}

TEST_P(InterruptedEnsemble, that_keeps_no_frames_ends_with_the_analyses_of_all) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(ensemble_of("whole"), folder.path()).exit_code, 0);
  std::vector<std::string> words = ensemble_of("parts");
  words.insert(words.end(), {"--keep", "analysis"});
  const std::vector<int> codes = stop_until_done([&] { return start_talus(words, folder.path()); },
                                                 GetParam(), 50, folder.path("parts"));
  EXPECT_EQ(codes.back(), 0);
  EXPECT_EQ(text_of(folder.path("parts/averages.csv")), text_of(folder.path("whole/averages.csv")));
  for (const char* seed : {"1", "2", "3", "4"}) {
    const std::string member = std::string("parts/seed-") + seed + ".h5";
    EXPECT_FALSE(std::filesystem::exists(folder.path(member + ".run"))) << member;
    EXPECT_EQ(hash_in(folder, member), hash_in(folder, std::string("whole/seed-") + seed + ".h5"));
    EXPECT_EQ(run_talus({"check", member}, folder.path()).exit_code, 0) << member;
    EXPECT_EQ(
        run_talus({"render", member, "--map", "size", "--at", "0", "-o", "x.png"}, folder.path()).exit_code,
        66)
        << member;
  }
}

TEST(Ensemble, that_keeps_less_goes_on_from_what_is_there) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(ensemble_of("e", "1-3"), folder.path()).exit_code, 0);
  const std::string before = text_of(folder.path("e/averages.csv"));
  const auto has_frames = [&](int seed) {
    const Outcome render = run_talus(
        {"render", "e/seed-" + std::to_string(seed) + ".h5", "--map", "size", "--at", "0", "-o", "x.png"},
        folder.path());
    EXPECT_TRUE(render.exit_code == 0 ||
                render.err.find(".h5 has no frames: it was kept for its analysis alone "
                                "(--keep analysis)") != std::string::npos)
        << render.err;
    return render.exit_code == 0;
  };
  std::vector<std::string> words = ensemble_of("e", "1-3");
  words.insert(words.end(), {"--keep", "1"});
  const Outcome less = run_talus(words, folder.path());
  ASSERT_EQ(less.exit_code, 0) << less.err;
  EXPECT_NE(less.err.find("the frames of 2 members that are done were removed (--keep 1)"), std::string::npos)
      << less.err;
  EXPECT_TRUE(has_frames(1) && !has_frames(2) && !has_frames(3));
  EXPECT_EQ(text_of(folder.path("e/averages.csv")), before);
  const auto written = std::filesystem::last_write_time(folder.path("e/seed-2.h5"));
  EXPECT_EQ(run_talus(ensemble_of("e", "4"), folder.path()).exit_code, 0)
      << "the folder records what it keeps";
  EXPECT_FALSE(has_frames(4));
  EXPECT_EQ(std::filesystem::last_write_time(folder.path("e/seed-2.h5")), written);
  const Outcome status = run_talus({"ensemble", "status", "e"}, folder.path());
  EXPECT_NE(
      status.out.find("e: 4 of 4 done, 0 under way\nkept: the analyses of all members that are done, and "
                      "the frames of 1\n"),
      std::string::npos)
      << status.out;
  const Outcome json = run_talus({"ensemble", "status", "e", "--json"}, folder.path());
  EXPECT_EQ(json_value(json.out, "keep"), "1");
  EXPECT_EQ(json_value(json.out, "runs"), "1");
  EXPECT_EQ(run_talus({"ensemble", "average", "e"}, folder.path()).exit_code, 0);
  EXPECT_EQ(run_talus({"analyze", "e/seed-2.h5"}, folder.path()).exit_code, 0) << "read from the file";
  const Outcome other = run_talus({"analyze", "e/seed-2.h5", "--set", "gamma_c=0.3"}, folder.path());
  EXPECT_EQ(other.exit_code, 66);
  EXPECT_NE(other.err.find("compute it again with talus run"), std::string::npos) << other.err;
  words.back() = "none";
  EXPECT_EQ(run_talus(words, folder.path()).exit_code, 64);
}

TEST(Ensemble, of_an_earlier_version_goes_on_with_what_it_has_kept_of_runs) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(ensemble_of("e", "1-2"), folder.path()).exit_code, 0);
  for (const char* table : {"e/seed-1.csv", "e/seed-2.csv"})
    write_file(folder, table, "quantity,unit,value\n");
  EXPECT_EQ(run_talus(ensemble_of("e", "1-2"), folder.path()).exit_code, 0) << "next to their runs";
  std::filesystem::remove(folder.path("e/seed-2.h5"));
  for (const std::vector<std::string>& words : {ensemble_of("e", "1-2"), {"ensemble", "work", "e"}}) {
    const Outcome lost = run_talus(words, folder.path());
    EXPECT_EQ(lost.exit_code, 65);
    EXPECT_NE(lost.err.find("e/seed-2.csv is the table of a member whose run was not kept by an earlier "
                            "version of Talus; use another folder, or remove the table"),
              std::string::npos)
        << lost.err;
  }
  std::filesystem::remove(folder.path("e/seed-2.csv"));
  EXPECT_EQ(run_talus(ensemble_of("e", "1-2"), folder.path()).exit_code, 0);
}

INSTANTIATE_TEST_SUITE_P(Signals, InterruptedEnsemble, testing::Values(SIGINT, SIGTERM, SIGKILL));

TEST(Ensemble, is_shared_by_workers_which_begin_each_member_once) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(ensemble_of("e", "1"), folder.path()).exit_code,
            0);  // creates the ensemble for the workers
  const pid_t first = start_talus(ensemble_of("e", "1-12"), folder.path());
  const std::string manifest = folder.path("e/ensemble.manifest");
  for (int wait = 0; wait < 1000 && text_of(manifest).find("seeds 1-12") == std::string::npos; ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::vector<Outcome> ends;
  for (int k = 0; k < 2; ++k) ends.push_back(run_talus({"ensemble", "work", "e"}, folder.path()));
  EXPECT_EQ(wait_for(first), 0) << errors_in(folder.path());
  for (const Outcome& end : ends) EXPECT_EQ(end.exit_code, 0) << end.err;
  EXPECT_EQ(count_of_lines(text_of(folder.path("e/members.csv"))), 13u)
      << "it waits for members that others compute";
  std::string begun;
  for (const Outcome& end : ends) begun += end.out;
  for (const auto& log : std::filesystem::directory_iterator(folder.path("e/workers")))
    begun += text_of(log.path().string());
  for (int seed = 1; seed <= 12; ++seed) {
    const std::string line = "seed-" + std::to_string(seed) + " begun\n";
    const std::size_t at = begun.find(line);
    ASSERT_NE(at, std::string::npos) << line;
    EXPECT_EQ(begun.find(line, at + 1), std::string::npos) << "twice: " << line;
  }
}

TEST(Ensemble, may_be_extended_while_it_is_computed) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  const pid_t first = start_talus(ensemble_of("e", "1-4"), folder.path());
  for (int wait = 0; wait < 1000 && !std::filesystem::exists(folder.path("e/ensemble.manifest")); ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const Outcome second = run_talus(ensemble_of("e", "5-6"), folder.path());
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_NE(second.out.find("e: 6 of 6 done"), std::string::npos) << second.out;
  EXPECT_EQ(wait_for(first), 0) << errors_in(folder.path());
}

TEST(Ensemble, replaces_a_worker_that_was_killed) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  std::vector<std::string> words = ensemble_of("e", "1-6");
  words.insert(words.end(), {"--jobs", "1"});
  const pid_t ensemble = start_talus(words, folder.path());
  // The worker writes its process number into its claim: "process 123 on host a, ...".
  std::string word, worker;
  for (int wait = 0; wait < 30000 && worker.empty(); ++wait) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    for (int seed = 2; seed <= 6 && worker.empty(); ++seed)  // a first member is done by then
      std::ifstream(folder.path("e/seed-" + std::to_string(seed) + ".claim-0")) >> word >> worker;
  }
  ASSERT_FALSE(worker.empty());
  kill(std::stoi(worker), SIGKILL);
  EXPECT_EQ(wait_for(ensemble), 0) << errors_in(folder.path());
  EXPECT_EQ(count_of_lines(text_of(folder.path("e/members.csv"))), 7u);
}

/// Waits for a number in a file after `words_before` words and returns it; 0 after 30 s.
int number_in(const std::string& path, int words_before = 0) {
  for (int wait = 0; wait < 3000; ++wait) {
    std::ifstream file(path);
    std::string word;
    for (int k = 0; k < words_before; ++k) file >> word;
    if (int number = 0; file >> number) return number;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return 0;
}

TEST(Ensemble, takes_a_member_for_failed_that_is_killed_but_not_with_its_worker) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", "[bed]\nlength = 50\ndepth = 20\n");
  ASSERT_EQ(
      run_talus({"ensemble", "bed.toml", "--seeds", "1", "--jobs", "0", "-o", "e"}, folder.path()).exit_code,
      0);
  for (const bool with_worker : {true, false}) {
    const pid_t work = start_talus({"ensemble", "work", "e"}, folder.path());
    const int worker = number_in(folder.path("e/seed-1.claim-0"), 1);  // "process 123 on host a"
    ASSERT_EQ(worker, work);
    const std::string process = std::to_string(worker);
    const int member = number_in("/proc/" + process + "/task/" + process + "/children");
    ASSERT_GT(member, 0);
    kill(member, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    if (with_worker) kill(worker, SIGKILL);
    wait_for(work);
    EXPECT_EQ(std::filesystem::exists(folder.path("e/seed-1.failed")), !with_worker);
    std::filesystem::remove(folder.path("e/seed-1.claim-0"));
  }
}

TEST(Ensemble, takes_over_what_a_worker_of_another_machine_has_left) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(ensemble_of("e", "1"), folder.path()).exit_code, 0);
  std::filesystem::remove(folder.path("e/seed-1.h5"));
  write_file(folder, "e/seed-1.claim-0", "process 1 on host far, boot another\n...");
  const Outcome status = run_talus({"ensemble", "status", "e"}, folder.path());
  EXPECT_NE(status.out.find("under way: seed-1, process 1 on host far"), std::string::npos) << status.out;
  const Outcome done = run_talus({"ensemble", "work", "e", "--stale", "1"}, folder.path());
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find("seed-1 done\n"), std::string::npos) << done.out;
  EXPECT_FALSE(std::filesystem::exists(folder.path("e/seed-1.claim-0")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("e/seed-1.claim-1")));
}

TEST(Ensemble, shows_what_failed_leaves_it_out_and_tries_it_again) {
  const TemporaryFolder folder;
  // Half of these beds come to rest within so short a time.
  write_file(folder, "bed.toml", std::string(tiny_bed) + "[deposition]\nmax_time = 0.05\n");
  const Outcome failed = run_talus(ensemble_of("e", "1-2"), folder.path());
  EXPECT_EQ(failed.exit_code, 65) << failed.out;
  EXPECT_NE(failed.out.find("failed: seed-1, exit code 65: talus: error: "), std::string::npos) << failed.out;
  EXPECT_NE(failed.err.find("left out of the means"), std::string::npos) << failed.err;
  EXPECT_EQ(run_talus({"ensemble", "work", "e"}, folder.path()).out.find("begun"), std::string::npos)
      << "a failed member stays unchanged";
  const Outcome retry = run_talus({"ensemble", "retry", "e"}, folder.path());
  EXPECT_NE(retry.out.find("2 members are waiting again"), std::string::npos) << retry.out;
  EXPECT_NE(run_talus({"ensemble", "work", "e"}, folder.path()).out.find("seed-1 begun"), std::string::npos);
}

TEST(Ensemble, begins_no_more_once_the_mean_is_known_well_enough) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  std::vector<std::string> words = ensemble_of("e", "1-30");
  words.insert(words.end(), {"--until", "unconverged_steps:1000", "--jobs", "1"});
  const Outcome done = run_talus(words, folder.path());
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find("e: 5 of 30 done"), std::string::npos) << done.out;
  const Outcome status = run_talus({"ensemble", "status", "e", "--json"}, folder.path());
  EXPECT_EQ(json_value(status.out, "done"), "5");
  EXPECT_EQ(json_value(status.out, "waiting"), "25");
}

int steps_of(const std::string& run, const TemporaryFolder& folder) {
  return std::stoi("0" + json_value(run_talus({"info", run, "--json"}, folder.path()).out, "steps"));
}

TEST(Ensemble, stops_in_time_and_goes_on_where_it_was) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", "[bed]\nlength = 50\ndepth = 20\n");
  std::vector<std::string> words = ensemble_of("e", "1");
  words.insert(words.end(), {"--max-wall", "00:00:03"});
  const Outcome stopped = run_talus(words, folder.path());
  EXPECT_EQ(stopped.exit_code, 75) << stopped.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path("e/seed-1.claim-0")));
  const int steps = steps_of("e/seed-1.h5", folder);
  EXPECT_GT(steps, 1);
  EXPECT_EQ(run_talus(words, folder.path()).exit_code, 75);
  EXPECT_GT(steps_of("e/seed-1.h5", folder), steps);
}

TEST(Ensemble, of_a_bad_form_is_refused_before_anything_is_made) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  EXPECT_EQ(run_talus({"ensemble", "bed.toml"}, folder.path()).exit_code, 64) << "not a folder";
  EXPECT_EQ(run_talus({"ensemble", "bed.toml", "--until", "theta_c", "-o", "e"}, folder.path()).exit_code,
            64);
  EXPECT_EQ(run_talus({"ensemble", "bed.toml", "--seeds", "4-1", "-o", "e"}, folder.path()).exit_code, 64);
  const Outcome key = run_talus({"ensemble", "bed.toml", "--vary", "tilt.stp=1", "-o", "e"}, folder.path());
  EXPECT_EQ(key.exit_code, 65);
  EXPECT_TRUE(key.err.starts_with("--vary tilt.stp=1: error: ")) << key.err;
  EXPECT_EQ(key.err.find("--set"), std::string::npos) << key.err;
  EXPECT_EQ(run_talus({"ensemble", "bed.toml", "--until", "theta_x:1", "-o", "e"}, folder.path()).exit_code,
            64);
  EXPECT_EQ(run_talus({"ensemble", "status", "e"}, folder.path()).exit_code, 66);
  EXPECT_EQ(run_talus({"ensemble", "work", ""}, folder.path()).exit_code, 64)
      << "same as work \"$FOLDER\" without it";
  EXPECT_FALSE(std::filesystem::exists(folder.path("e")));
}

TEST(Ensemble, leaves_a_member_for_later_whose_run_somebody_else_writes) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  std::vector<std::string> words = ensemble_of("e", "1-3");
  words.insert(words.end(), {"--jobs", "0"});
  ASSERT_EQ(run_talus(words, folder.path()).exit_code, 0);
  std::filesystem::create_directory(folder.path("e/seed-1.h5.run"));
  write_file(folder, "e/seed-1.h5.run/lock", "process 12 on host a");
  pid_t work = 0;
  {
    const Descriptor lock(open(folder.path("e/seed-1.h5.run/lock").c_str(), O_RDWR | O_CLOEXEC));
    ASSERT_EQ(flock(lock.get(), LOCK_EX), 0);
    work = start_talus({"ensemble", "work", "e"}, folder.path());
    const auto others_are_done = [&] {
      return std::filesystem::exists(folder.path("e/seed-2.h5")) &&
             std::filesystem::exists(folder.path("e/seed-3.h5"));
    };
    for (int wait = 0; wait < 6000 && !others_are_done(); ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_TRUE(others_are_done());
    EXPECT_FALSE(has_ended(work)) << "it waits";
    EXPECT_NE(errors_in(folder.path()).find("seed-1 is postponed: process 12 on host a is writing its run"),
              std::string::npos)
        << errors_in(folder.path());
    EXPECT_FALSE(std::filesystem::exists(folder.path("e/seed-1.claim-0")));
  }
  EXPECT_EQ(wait_for(work), 0) << errors_in(folder.path());
  EXPECT_TRUE(std::filesystem::exists(folder.path("e/seed-1.h5")));
}

TEST(Ensemble, begins_a_member_anew_whose_folder_is_damaged) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  std::vector<std::string> words = ensemble_of("e", "1");
  words.insert(words.end(), {"--jobs", "0"});
  ASSERT_EQ(run_talus(words, folder.path()).exit_code, 0);
  std::filesystem::create_directory(folder.path("e/seed-1.h5.run"));
  write_file(folder, "e/seed-1.h5.run/manifest", "talus run folder 1\nheader");
  const Outcome work = run_talus({"ensemble", "work", "e"}, folder.path());
  EXPECT_NE(work.out.find("seed-1 done\n"), std::string::npos) << work.out;
  const std::string log = text_of(folder.path("e/seed-1.log"));
  EXPECT_NE(log.find("is in e/seed-1.h5.damaged; the member is restarted"), std::string::npos) << log;
  EXPECT_TRUE(std::filesystem::exists(folder.path("e/seed-1.h5.damaged/manifest"))) << "nothing is lost";
  EXPECT_FALSE(std::filesystem::exists(folder.path("e/seed-1.failed")));
}

TEST(Ensemble, is_left_without_claims_and_locks) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  write_file(folder, "other.toml", std::string(tiny_bed) + "[contact]\nfriction = 0.2\n");
  ASSERT_EQ(run_talus(ensemble_of("e", "1"), folder.path()).exit_code, 0);
  EXPECT_EQ(run_talus({"ensemble", "other.toml", "--seeds", "1", "-o", "e"}, folder.path()).exit_code, 65);
  EXPECT_FALSE(std::filesystem::exists(folder.path("e/ensemble.manifest.lock")));
  for (const char* number : {"0", "7"})
    write_file(folder, std::string("e/seed-1.claim-") + number, "process 1 on host far, boot another\n...");
  std::filesystem::create_directory(folder.path("e/averages.csv.talus.part"));  // blocks the file of averages
  EXPECT_NE(run_talus({"ensemble", "average", "e"}, folder.path()).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder.path("e/averages.lock")));
  ASSERT_EQ(run_talus({"ensemble", "work", "e"}, folder.path()).exit_code, 0);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path("e")))
    EXPECT_EQ(entry.path().string().find(".claim-"), std::string::npos) << entry.path();
}

TEST(Ensemble, computes_a_member_whatever_the_number_of_a_dead_claim) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  std::vector<std::string> words = ensemble_of("e", "1-2");
  words.insert(words.end(), {"--jobs", "0"});
  ASSERT_EQ(run_talus(words, folder.path()).exit_code, 0);
  write_file(folder, "e/seed-1.claim-2147483647", "process 1 on host far, boot another\n");
  write_file(folder, "e/seed-2.claim-07", "process 1 on host far, boot another\n");
  EXPECT_EQ(run_talus({"ensemble", "work", "e", "--stale", "1"}, folder.path()).exit_code, 0);
  for (const char* table : {"e/seed-1.h5", "e/seed-2.h5"})
    EXPECT_TRUE(std::filesystem::exists(folder.path(table))) << table;
}

TEST(Ensemble, does_not_end_well_because_a_failure_does_not_tell_its_code) {
  const TemporaryFolder folder;
  write_file(folder, "bed.toml", tiny_bed);
  ASSERT_EQ(run_talus(ensemble_of("e", "1"), folder.path()).exit_code, 0);
  for (const char* text : {"", "exit code 0\nall is well\n", "exit code 256\n", "exit code -1\n", "what\n"}) {
    std::filesystem::remove(folder.path("e/seed-1.h5"));
    write_file(folder, "e/seed-1.failed", text);
    const Outcome outcome = run_talus(ensemble_of("e", "1"), folder.path());
    EXPECT_EQ(outcome.exit_code, 65) << text;
    EXPECT_NE(outcome.err.find("e/seed-1.failed is not in the form that talus writes"), std::string::npos)
        << outcome.err;
  }
}

}  // namespace
}  // namespace talus::test
