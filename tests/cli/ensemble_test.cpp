/// Ensembles of a tiny bed: workers that share a folder, interruptions, takeovers, failures, and reports.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include <csignal>
#include <fstream>
#include <thread>

#include "base/output_file.h"
#include "support/commands.h"
#include "support/places.h"
#include "support/runs.h"

namespace talus::test {
namespace {

Words ensemble_of(const std::string& folder, const std::string& seeds = "1-4") {
  return {"ensemble", "bed.toml", "--seeds", seeds, "-o", folder};
}

using Ensemble = StableBedTest;

TEST_F(Ensemble, has_the_bits_of_talus_run_and_its_analysis) {
  ASSERT_TRUE(ends(talus(ensemble_of("e", "1-2") + Words{"--vary", "contact.friction=0.3,0.5"}), 0,
                   {"e: 4 of 4 done, 0 under way\n"}));
  const std::string alone =
      folder_.hash(kept_run(stable_bed, {"--seed", "2", "--set", "contact.friction=0.3"}).string());
  EXPECT_EQ(folder_.hash("e/contact.friction=0.3/seed-2.h5"), alone);
  EXPECT_TRUE(has_all(folder_.text("e/members.csv"), {"variant,contact.friction,seed,state_hash,",
                                                      "\"contact.friction=0.3\",0.3,2," + alone + ","}));
  const Outcome analysis = talus({"analyze", "e/contact.friction=0.3/seed-2.h5"});
  EXPECT_TRUE(has(analysis.out + analysis.err, "analysis read from the file")) << analysis.out;
  EXPECT_EQ(count_of(folder_.text("e/members.csv"), "\n"), 5u);
}

TEST_F(Ensemble, that_is_complete_is_only_read_and_grows_by_seeds) {
  ASSERT_EQ(talus(ensemble_of("e", "1-2")).exit_code, 0);
  const auto written = std::filesystem::last_write_time(folder_.path("e/seed-1.h5"));
  ASSERT_EQ(talus(ensemble_of("e", "1-2")).exit_code, 0);
  EXPECT_TRUE(has(talus(ensemble_of("e", "3")).out, "3 of 3 done"));
  EXPECT_EQ(std::filesystem::last_write_time(folder_.path("e/seed-1.h5")), written);
}

TEST_F(Ensemble, has_averages_over_tilt_that_do_not_depend_on_when_members_came) {
  ASSERT_EQ(talus(ensemble_of("at-once", "1-3")).exit_code, 0);
  for (const char* seeds : {"3", "1", "2"}) ASSERT_EQ(talus(ensemble_of("one-by-one", seeds)).exit_code, 0);
  EXPECT_EQ(folder_.text("at-once/averages.csv"), folder_.text("one-by-one/averages.csv"));
  EXPECT_EQ(folder_.text("at-once/ensemble.h5"), folder_.text("one-by-one/ensemble.h5"));
  EXPECT_TRUE(has(folder_.text("at-once/averages.csv"), "over_tilt,1.5,contacts/coordination_number,1,3,"));
  if (std::system("/usr/bin/python3 -c 'import h5py' 2>/dev/null") != 0)
    GTEST_SKIP() << "python3-h5py is not installed";
  const std::string read = "cd " + folder_.path().string() + " && /usr/bin/python3 " + source_folder() +
                           "/tests/cli/ensemble_with_h5py.py at-once/ensemble.h5 > read.txt 2>&1";
  EXPECT_EQ(std::system(read.c_str()), 0) << folder_.text("read.txt");
  EXPECT_EQ(folder_.text("read.txt"), "1 2 3 0.0 0.5 1.0 1.5\n");
}

TEST_F(Ensemble, is_averaged_again_from_the_runs_of_its_members) {
  ASSERT_EQ(talus(ensemble_of("e", "1-2")).exit_code, 0);
  const std::string before = folder_.text("e/averages.csv");
  for (const char* name : {"e/averages.csv", "e/ensemble.h5", "e/members.csv"})
    std::filesystem::remove(folder_.path(name));
  // Like the output of talus run: without an analysis.
  ASSERT_EQ(talus({"run", "bed.toml", "--seed", "2", "-o", "e/seed-2.h5", "--overwrite"}).exit_code, 0);
  EXPECT_EQ(talus({"ensemble", "status", "e"}).exit_code, 0);
  EXPECT_TRUE(ends(talus({"ensemble", "average", "e"}), 0));
  EXPECT_EQ(folder_.text("e/averages.csv"), before);
  EXPECT_EQ(count_of(folder_.text("e/members.csv"), "\n"), 3u);
  EXPECT_TRUE(folder_.has_file("e/ensemble.h5"));
  const Outcome check = talus({"check", "e/ensemble.h5"});
  EXPECT_TRUE(ends(check, 65, {"e/ensemble.h5: is not a Talus run file"}));
  EXPECT_EQ(check.out, "") << "no damage";
  const std::string whole = folder_.text("e/seed-1.h5");
  write_file(folder_, "e/seed-1.h5", whole.substr(0, whole.size() / 2));
  EXPECT_TRUE(ends(talus({"ensemble", "average", "e"}), 65, {"e/seed-1.h5: is damaged"}));
  std::filesystem::remove(folder_.path("e/seed-1.h5"));
  EXPECT_EQ(talus(ensemble_of("e", "1-2")).exit_code, 0) << "it is computed again";
}

TEST_F(Ensemble, is_averaged_by_one_process_at_a_time_and_none_is_refused) {
  ASSERT_EQ(talus(ensemble_of("e", "1-3")).exit_code, 0);
  const std::string before = folder_.text("e/averages.csv");
  for (int round = 0; round < 5; ++round) {
    std::vector<pid_t> processes;
    for (int k = 0; k < 6; ++k) processes.push_back(folder_.start({"ensemble", "average", "e"}));
    for (const pid_t process : processes) EXPECT_EQ(wait_for(process), 0) << folder_.errors();
  }
  EXPECT_EQ(folder_.text("e/averages.csv"), before);
  EXPECT_FALSE(folder_.has_file("e/averages.lock"));
  EXPECT_EQ(talus({"ensemble", "average", "none"}).exit_code, 66);
  EXPECT_FALSE(folder_.has_file("none"));
}

class InterruptedEnsemble : public StableBedTest, public testing::WithParamInterface<int> {};

TEST_P(InterruptedEnsemble, goes_on_to_the_same_bits) {
  ASSERT_EQ(talus(ensemble_of("whole")).exit_code, 0);
  const std::vector<int> codes = stop_until_done([&] { return folder_.start(ensemble_of("parts")); },
                                                 GetParam(), 50, folder_.path("parts"));
  for (const int code : codes) EXPECT_TRUE(code == 0 || code == -1 || code == 75) << code << folder_.errors();
  EXPECT_EQ(codes.back(), 0);
  for (const char* member : {"seed-1.h5", "seed-2.h5", "seed-3.h5", "seed-4.h5"})
    EXPECT_EQ(folder_.hash(std::string("parts/") + member), folder_.hash(std::string("whole/") + member))
        << member;
  EXPECT_EQ(folder_.text("parts/averages.csv"), folder_.text("whole/averages.csv"));
}

TEST_P(InterruptedEnsemble, that_keeps_no_frames_ends_with_the_analyses_of_all) {
  ASSERT_EQ(talus(ensemble_of("whole")).exit_code, 0);
  const Words words = ensemble_of("parts") + Words{"--keep", "analysis"};
  const std::vector<int> codes =
      stop_until_done([&] { return folder_.start(words); }, GetParam(), 50, folder_.path("parts"));
  EXPECT_EQ(codes.back(), 0);
  EXPECT_EQ(folder_.text("parts/averages.csv"), folder_.text("whole/averages.csv"));
  for (const char* seed : {"1", "2", "3", "4"}) {
    const std::string member = std::string("parts/seed-") + seed + ".h5";
    EXPECT_FALSE(folder_.has_file(member + ".run")) << member;
    EXPECT_EQ(folder_.hash(member), folder_.hash(std::string("whole/seed-") + seed + ".h5"));
    EXPECT_EQ(talus({"check", member}).exit_code, 0) << member;
    EXPECT_EQ(talus({"render", member, "--map", "size", "--at", "0", "-o", "x"}).exit_code, 66) << member;
  }
}

TEST_F(Ensemble, that_keeps_less_goes_on_from_what_is_there) {
  ASSERT_EQ(talus(ensemble_of("e", "1-3")).exit_code, 0);
  const std::string before = folder_.text("e/averages.csv");
  const auto has_frames = [&](int seed) {
    const Outcome render =
        talus({"render", "e/seed-" + std::to_string(seed) + ".h5", "--map", "size", "--at", "0", "-o", "x"});
    EXPECT_TRUE(render.exit_code == 0 || has(render.err,
                                             ".h5 has no frames: it was kept for its analysis alone "
                                             "(--keep analysis)"))
        << render.err;
    return render.exit_code == 0;
  };
  Words words = ensemble_of("e", "1-3") + Words{"--keep", "1"};
  const Outcome less = talus(words);
  ASSERT_EQ(less.exit_code, 0) << less.err;
  EXPECT_TRUE(has(less.err, "the frames of 2 members that are done were removed (--keep 1)"));
  EXPECT_TRUE(has_frames(1) && !has_frames(2) && !has_frames(3));
  EXPECT_EQ(folder_.text("e/averages.csv"), before);
  const auto written = std::filesystem::last_write_time(folder_.path("e/seed-2.h5"));
  EXPECT_EQ(talus(ensemble_of("e", "4")).exit_code, 0) << "the folder records what it keeps";
  EXPECT_FALSE(has_frames(4));
  EXPECT_EQ(std::filesystem::last_write_time(folder_.path("e/seed-2.h5")), written);
  EXPECT_TRUE(has(talus({"ensemble", "status", "e"}).out,
                  "e: 4 of 4 done, 0 under way\nkept: the analyses of all members that are done, and "
                  "the frames of 1\n"));
  const Outcome json = talus({"ensemble", "status", "e", "--json"});
  EXPECT_EQ(json_value(json.out, "keep"), "1");
  EXPECT_EQ(json_value(json.out, "runs"), "1");
  EXPECT_EQ(talus({"ensemble", "average", "e"}).exit_code, 0);
  EXPECT_EQ(talus({"analyze", "e/seed-2.h5"}).exit_code, 0) << "read from the file";
  EXPECT_TRUE(ends(talus({"analyze", "e/seed-2.h5", "--set", "gamma_c=0.3"}), 66,
                   {"compute it again with talus run"}));
  words.back() = "none";
  EXPECT_EQ(talus(words).exit_code, 64);
}

INSTANTIATE_TEST_SUITE_P(Signals, InterruptedEnsemble, testing::Values(SIGINT, SIGTERM, SIGKILL));

TEST_F(Ensemble, is_shared_by_workers_which_begin_each_member_once) {
  ASSERT_TRUE(ends(talus(ensemble_of("e", "1")), 0));  // creates the ensemble for the workers
  const pid_t first = folder_.start(ensemble_of("e", "1-12"));
  const std::string manifest = folder_.path("e/ensemble.manifest");
  wait_until([&] { return text_of(manifest).find("\"1-12\"") != std::string::npos; });
  std::vector<Outcome> ends;
  for (int k = 0; k < 2; ++k) ends.push_back(talus({"ensemble", "work", "e"}));
  EXPECT_EQ(wait_for(first), 0) << folder_.errors();
  for (const Outcome& end : ends) EXPECT_EQ(end.exit_code, 0) << end.err;
  EXPECT_EQ(count_of(folder_.text("e/members.csv"), "\n"), 13u) << "it waits for members that others compute";
  std::string begun;
  for (const Outcome& end : ends) begun += end.out;
  for (const auto& log : std::filesystem::directory_iterator(folder_.path("e/workers")))
    begun += text_of(log.path().string());
  for (int seed = 1; seed <= 12; ++seed)
    EXPECT_EQ(count_of(begun, "seed-" + std::to_string(seed) + " begun\n"), 1u) << seed;
}

TEST_F(Ensemble, may_be_extended_while_it_is_computed) {
  const pid_t first = folder_.start(ensemble_of("e", "1-4"));
  wait_until([&] { return folder_.has_file("e/ensemble.manifest"); });
  EXPECT_TRUE(ends(talus(ensemble_of("e", "5-6")), 0, {"e: 6 of 6 done"}));
  EXPECT_EQ(wait_for(first), 0) << folder_.errors();
}

TEST_F(Ensemble, replaces_a_worker_that_was_killed) {
  const pid_t ensemble = folder_.start(ensemble_of("e", "1-6") + Words{"--jobs", "1"});
  // The worker writes its process number into its claim: "process 123 on host a, ...".
  std::string word, worker;
  ASSERT_TRUE(wait_until([&] {
    for (int seed = 2; seed <= 6 && worker.empty(); ++seed)  // a first member is done by then
      std::ifstream(folder_.path("e/seed-" + std::to_string(seed) + ".claim-0")) >> word >> worker;
    return !worker.empty();
  }));
  kill(std::stoi(worker), SIGKILL);
  EXPECT_EQ(wait_for(ensemble), 0) << folder_.errors();
  EXPECT_EQ(count_of(folder_.text("e/members.csv"), "\n"), 7u);
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

TEST_F(Ensemble, takes_a_member_for_failed_that_is_killed_but_not_with_its_worker) {
  const CommandFolder folder("[bed]\nlength = 50\ndepth = 20\n");
  ASSERT_EQ(folder.talus({"ensemble", "bed.toml", "--seeds", "1", "--jobs", "0", "-o", "e"}).exit_code, 0);
  for (const bool with_worker : {true, false}) {
    const pid_t work = folder.start({"ensemble", "work", "e"});
    const int worker = number_in(folder.path("e/seed-1.claim-0"), 1);  // "process 123 on host a"
    ASSERT_EQ(worker, work);
    const std::string process = std::to_string(worker);
    const int member = number_in("/proc/" + process + "/task/" + process + "/children");
    ASSERT_GT(member, 0);
    kill(member, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    if (with_worker) kill(worker, SIGKILL);
    wait_for(work);
    EXPECT_EQ(folder.has_file("e/seed-1.failed"), !with_worker);
    std::filesystem::remove(folder.path("e/seed-1.claim-0"));
  }
}

TEST_F(Ensemble, takes_over_what_a_worker_of_another_machine_has_left) {
  ASSERT_EQ(talus(ensemble_of("e", "1")).exit_code, 0);
  std::filesystem::remove(folder_.path("e/seed-1.h5"));
  write_file(folder_, "e/seed-1.claim-0", "process 1 on host far, boot another\n...");
  EXPECT_TRUE(has(talus({"ensemble", "status", "e"}).out, "under way: seed-1, process 1 on host far"));
  EXPECT_TRUE(ends(talus({"ensemble", "work", "e", "--stale", "1"}), 0, {"seed-1 done\n"}));
  EXPECT_FALSE(folder_.has_file("e/seed-1.claim-0"));
  EXPECT_FALSE(folder_.has_file("e/seed-1.claim-1"));
}

TEST_F(Ensemble, shows_what_failed_leaves_it_out_and_tries_it_again) {
  const CommandFolder folder;
  // Half of these beds come to rest within so short a time.
  write_file(folder, "bed.toml", std::string(stable_bed) + "[deposition]\nmax_time = 0.05\n");
  const Outcome failed = folder.talus(ensemble_of("e", "1-2"));
  EXPECT_TRUE(ends(failed, 65, {"left out of the means"}));
  EXPECT_TRUE(has(failed.out, "failed: seed-1, exit code 65: talus: error: "));
  EXPECT_FALSE(has(folder.talus({"ensemble", "work", "e"}).out, "begun"))
      << "a failed member stays unchanged";
  EXPECT_TRUE(has(folder.talus({"ensemble", "retry", "e"}).out, "2 members are waiting again"));
  EXPECT_TRUE(has(folder.talus({"ensemble", "work", "e"}).out, "seed-1 begun"));
}

TEST_F(Ensemble, begins_no_more_once_the_mean_is_known_well_enough) {
  EXPECT_TRUE(
      ends(talus(ensemble_of("e", "1-30") + Words{"--until", "unconverged_steps:1000", "--jobs", "1"}), 0,
           {"e: 5 of 30 done"}));
  const Outcome status = talus({"ensemble", "status", "e", "--json"});
  EXPECT_EQ(json_value(status.out, "done"), "5");
  EXPECT_EQ(json_value(status.out, "waiting"), "25");
}

TEST_F(Ensemble, stops_in_time_and_goes_on_where_it_was) {
  const CommandFolder folder("[bed]\nlength = 50\ndepth = 20\n");
  const Words words = ensemble_of("e", "1") + Words{"--max-wall", "00:00:03"};
  const auto steps_after_a_while = [&] {
    EXPECT_TRUE(ends(folder.talus(words), 75));
    return std::stoi("0" + folder.info("e/seed-1.h5", "steps"));
  };
  const int steps = steps_after_a_while();
  EXPECT_FALSE(folder.has_file("e/seed-1.claim-0"));
  EXPECT_GT(steps, 1);
  EXPECT_GT(steps_after_a_while(), steps);
}

TEST_F(Ensemble, of_a_bad_form_is_refused_before_anything_is_made) {
  EXPECT_EQ(talus({"ensemble", "bed.toml"}).exit_code, 64) << "not a folder";
  EXPECT_EQ(talus({"ensemble", "bed.toml", "--until", "theta_c", "-o", "e"}).exit_code, 64);
  EXPECT_EQ(talus({"ensemble", "bed.toml", "--seeds", "4-1", "-o", "e"}).exit_code, 64);
  for (const char* command : {"ensemble", "study"}) {
    const Outcome key = talus({command, "bed.toml", "--vary", "tilt.stp=1", "-o", "e"});
    EXPECT_EQ(key.exit_code, 65);
    EXPECT_TRUE(key.err.starts_with("--vary tilt.stp=1: error: ")) << key.err;
    EXPECT_FALSE(has(key.err, "--set"));
  }
  EXPECT_EQ(talus({"ensemble", "bed.toml", "--until", "theta_x:1", "-o", "e"}).exit_code, 64);
  EXPECT_EQ(talus({"ensemble", "status", "e"}).exit_code, 66);
  EXPECT_EQ(talus({"ensemble", "work", ""}).exit_code, 64) << "same as work \"$FOLDER\" without it";
  EXPECT_FALSE(folder_.has_file("e"));
}

TEST_F(Ensemble, leaves_a_member_for_later_whose_run_somebody_else_writes) {
  ASSERT_EQ(talus(ensemble_of("e", "1-3") + Words{"--jobs", "0"}).exit_code, 0);
  std::filesystem::create_directory(folder_.path("e/seed-1.h5.run"));
  write_file(folder_, "e/seed-1.h5.run/lock", "process 12 on host a");
  pid_t work = 0;
  {
    const Descriptor lock(open(folder_.path("e/seed-1.h5.run/lock").c_str(), O_RDWR | O_CLOEXEC));
    ASSERT_EQ(flock(lock.get(), LOCK_EX), 0);
    work = folder_.start({"ensemble", "work", "e"});
    const auto others_are_done = [&] {
      return folder_.has_file("e/seed-2.h5") && folder_.has_file("e/seed-3.h5");
    };
    EXPECT_TRUE(wait_until(others_are_done));
    EXPECT_FALSE(has_ended(work)) << "it waits";
    EXPECT_TRUE(has(folder_.errors(), "seed-1 is postponed: process 12 on host a is writing its run"));
    EXPECT_FALSE(folder_.has_file("e/seed-1.claim-0"));
  }
  EXPECT_EQ(wait_for(work), 0) << folder_.errors();
  EXPECT_TRUE(folder_.has_file("e/seed-1.h5"));
}

TEST_F(Ensemble, begins_a_member_anew_whose_folder_is_damaged) {
  ASSERT_EQ(talus(ensemble_of("e", "1") + Words{"--jobs", "0"}).exit_code, 0);
  std::filesystem::create_directory(folder_.path("e/seed-1.h5.run"));
  write_file(folder_, "e/seed-1.h5.run/manifest", "talus run folder 1\nheader");
  EXPECT_TRUE(has(talus({"ensemble", "work", "e"}).out, "seed-1 done\n"));
  EXPECT_TRUE(has(folder_.text("e/seed-1.log"), "is in e/seed-1.h5.damaged; the member is restarted"));
  EXPECT_TRUE(folder_.has_file("e/seed-1.h5.damaged/manifest")) << "nothing is lost";
  EXPECT_FALSE(folder_.has_file("e/seed-1.failed"));
}

TEST_F(Ensemble, is_left_without_claims_and_locks) {
  write_file(folder_, "other.toml", std::string(stable_bed) + "[contact]\nfriction = 0.2\n");
  ASSERT_EQ(talus(ensemble_of("e", "1")).exit_code, 0);
  EXPECT_EQ(talus({"ensemble", "other.toml", "--seeds", "1", "-o", "e"}).exit_code, 65);
  EXPECT_FALSE(folder_.has_file("e/ensemble.manifest.lock"));
  for (const char* number : {"0", "7"})
    write_file(folder_, std::string("e/seed-1.claim-") + number, "process 1 on host far, boot another\n...");
  std::filesystem::create_directory(
      folder_.path("e/averages.csv.talus.part"));  // blocks the file of averages
  EXPECT_NE(talus({"ensemble", "average", "e"}).exit_code, 0);
  EXPECT_FALSE(folder_.has_file("e/averages.lock"));
  ASSERT_EQ(talus({"ensemble", "work", "e"}).exit_code, 0);
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path("e")))
    EXPECT_FALSE(has(entry.path().string(), ".claim-")) << entry.path();
}

TEST_F(Ensemble, does_not_end_well_because_a_failure_does_not_tell_its_code) {
  ASSERT_EQ(talus(ensemble_of("e", "1")).exit_code, 0);
  for (const char* text : {"", "exit code 0\nall is well\n", "exit code 256\n", "exit code -1\n", "what\n"}) {
    std::filesystem::remove(folder_.path("e/seed-1.h5"));
    write_file(folder_, "e/seed-1.failed", text);
    EXPECT_TRUE(
        ends(talus(ensemble_of("e", "1")), 65, {"e/seed-1.failed is not in the form that talus writes"}))
        << text;
  }
}

}  // namespace
}  // namespace talus::test
