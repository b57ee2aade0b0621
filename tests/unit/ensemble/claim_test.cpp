/// Claims of members, and their states. Pool of processes, which are instances of this test program that run
/// one test each.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <limits>
#include <thread>

#include "base/child_program.h"
#include "base/errors.h"
#include "ensemble/member_state.h"
#include "ensemble/worker.h"
#include "io/durable_file.h"
#include "support/exit_code.h"
#include "support/temporary_folder.h"

namespace talus::ensemble {
namespace {

const ClaimTimes quick{0.06};  // a heartbeat every 5 ms; dead after 60 ms

/// Writes a claim of a worker on another machine, with `beats` heartbeats.
void write_foreign_claim(const std::string& path, int beats) {
  std::ofstream(path) << "process 1 on host far, boot another\n" << std::string(beats, '.');
}

class ClaimTest : public test::FolderTest {
 protected:
  const std::string run = folder.path("seed-1.h5");
};

TEST_F(ClaimTest, is_given_to_one_until_the_object_ends) {
  {
    const std::optional<Claim> first = Claim::take(run, {}, quick);
    ASSERT_TRUE(first);
    EXPECT_FALSE(Claim::take(run, {}, quick));
    EXPECT_TRUE(std::filesystem::exists(folder.path("seed-1.claim-0")));
  }
  EXPECT_FALSE(std::filesystem::exists(claim_path(run, 0)));
  EXPECT_TRUE(Claim::take(run, {}, quick));
}

TEST_F(ClaimTest, tells_who_has_it_and_counts_heartbeats) {
  std::optional<Claim> claim = Claim::take(run, {}, quick);
  ASSERT_TRUE(claim);
  for (int k = 0; k < 2; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(6));
    EXPECT_TRUE(claim->record_heartbeat());
  }
  const std::optional<ClaimHolder> holder = read_claim(run, 0);
  ASSERT_TRUE(holder);
  EXPECT_TRUE(holder->worker.starts_with("process " + std::to_string(getpid()) + " on host "))
      << holder->worker;
  EXPECT_EQ(holder->beats, 2u);
}

TEST_F(ClaimTest, beats_only_as_often_as_it_is_told) {
  std::optional<Claim> claim = Claim::take(run, {}, {7200.0});
  EXPECT_TRUE(claim->record_heartbeat());
  EXPECT_EQ(read_claim(run, 0)->beats, 0u);
}

TEST_F(ClaimTest, is_alive_as_long_as_its_process_on_this_machine) {
  ClaimWatch watch{quick, {}};
  {
    const std::optional<Claim> claim = Claim::take(run, {}, quick);
    std::this_thread::sleep_for(
        std::chrono::milliseconds(80));  // longer than the lifetime of a foreign claim
    EXPECT_EQ(claim_state(run, 0, watch), ClaimState::alive);
    std::filesystem::copy_file(claim_path(run, 0), folder.path("left"));
  }
  std::filesystem::rename(folder.path("left"), claim_path(run, 0));  // state after a kill: without a lock
  EXPECT_EQ(claim_state(run, 0, watch), ClaimState::dead);
}

TEST_F(ClaimTest, of_another_machine_is_dead_once_it_has_not_grown_for_long_enough) {
  ClaimWatch watch{quick, {}};
  write_foreign_claim(claim_path(run, 0), 3);
  EXPECT_EQ(claim_state(run, 0, watch), ClaimState::unknown);
  write_foreign_claim(claim_path(run, 0), 4);
  EXPECT_EQ(claim_state(run, 0, watch), ClaimState::alive);
  std::this_thread::sleep_for(std::chrono::milliseconds(80));
  EXPECT_EQ(claim_state(run, 0, watch), ClaimState::dead);
}

TEST_F(ClaimTest, of_another_holder_counts_from_its_own_first_heartbeat) {
  ClaimWatch watch{quick, {}};
  write_foreign_claim(claim_path(run, 0), 30);
  EXPECT_EQ(claim_state(run, 0, watch), ClaimState::unknown);
  std::this_thread::sleep_for(std::chrono::milliseconds(80));
  // Meanwhile its worker has released it, and another has taken it.
  std::ofstream(claim_path(run, 0)) << "process 2 on host farther, boot third\n.";
  EXPECT_EQ(claim_state(run, 0, watch), ClaimState::unknown);
}

TEST_F(ClaimTest, of_the_next_number_replaces_a_dead_one_which_then_knows) {
  std::optional<Claim> old = Claim::take(run, {}, quick);
  ASSERT_TRUE(old->record_heartbeat());
  std::optional<Claim> next = Claim::take(run, 0, quick);
  ASSERT_TRUE(next);
  EXPECT_FALSE(old->record_heartbeat());
  EXPECT_TRUE(next->record_heartbeat());
  EXPECT_FALSE(Claim::take(run, 0, quick)) << "another process that found the same dead claim";
  EXPECT_FALSE(std::filesystem::exists(claim_path(run, 0)));
}

TEST_F(ClaimTest, is_not_taken_over_from_one_that_has_ended_meanwhile) {
  EXPECT_FALSE(Claim::take(run, 0, quick)) << "claim 0 was released, and claim 1 would not exclude a new 0";
  EXPECT_FALSE(std::filesystem::exists(claim_path(run, 1)));
}

TEST_F(ClaimTest, that_was_removed_is_lost) {
  std::optional<Claim> claim = Claim::take(run, {}, quick);
  std::filesystem::remove(claim_path(run, 0));
  EXPECT_FALSE(claim->record_heartbeat());
}

TEST_F(ClaimTest, is_lost_to_one_of_a_higher_number) {
  std::optional<Claim> claim = Claim::take(run, {}, quick);
  write_foreign_claim(claim_path(run, 1), 0);  // its worker has not yet removed the previous one
  EXPECT_FALSE(claim->record_heartbeat());
}

TEST_F(ClaimTest, lives_as_long_as_a_process_that_its_worker_has_started) {
  const std::optional<Claim> claim = Claim::take(run, {}, quick);
  const int file = open(claim_path(run, 0).c_str(), O_RDONLY | O_CLOEXEC);
  // The claim is held by the descriptor, which children inherit.
  int inherited = 0;
  for (int k = 3; k < 64; ++k) {
    struct stat here {
    }, there{};
    if (k != file && fstat(k, &here) == 0 && fstat(file, &there) == 0 && here.st_ino == there.st_ino)
      inherited += (fcntl(k, F_GETFD) & FD_CLOEXEC) == 0 ? 1 : 0;
  }
  EXPECT_EQ(inherited, 1);
  close(file);
}

TEST_F(ClaimTest, of_the_last_number_is_replaced_by_one_that_is_free) {
  const int last = std::numeric_limits<int>::max();
  for (const int number : {0, last}) write_foreign_claim(claim_path(run, number), 0);
  std::optional<Claim> claim = Claim::take(run, last, quick);
  ASSERT_TRUE(claim);
  EXPECT_EQ(claim->number(), 1);
  EXPECT_TRUE(claim->record_heartbeat());
  EXPECT_FALSE(std::filesystem::exists(claim_path(run, last)));
  EXPECT_EQ(claims_of(run).size(), 2u);
}

TEST(ClaimName, is_that_of_its_run_with_a_number) {
  const std::optional<ClaimName> name = parse_claim_name("seed-7.claim-12");
  ASSERT_TRUE(name);
  EXPECT_EQ(name->run, "seed-7");
  EXPECT_EQ(name->number, 12);
  for (const char* other : {"seed-7.h5", "seed-7.claim-", "seed-7.claim-x", "seed-7.claim-1x",
                            "seed-7.claim--1", "seed-7.claim-01", "seed-7.claim-2147483648"})
    EXPECT_FALSE(parse_claim_name(other)) << other;
}

void touch(const std::string& path) { std::ofstream file(path); }

TEST_F(ClaimTest, and_the_state_of_its_member_follow_from_the_files_beside_the_run) {
  std::filesystem::create_directory(folder.path("a"));
  const EnsemblePlan plan =
      plan_ensemble({1, 2, 3, 4}, {{"a", "", {}}, {"b", "", {}}}, folder.path().string());
  touch(folder.path("a/seed-1.h5"));
  touch(folder.path("a/seed-1.claim-0"));  // its worker has not released it yet
  touch(folder.path("a/seed-2.failed"));
  touch(folder.path("a/seed-3.claim-2"));
  touch(folder.path("a/seed-3.claim-10"));
  std::filesystem::create_directory(folder.path("a/seed-4.h5.run"));
  std::filesystem::create_directory(folder.path("a/seed-2.h5"));
  const std::vector<MemberState> states = scan_members(plan);
  ASSERT_EQ(states.size(), 8u);
  EXPECT_EQ(states[0].stage, MemberStage::done);
  EXPECT_EQ(states[2].stage, MemberStage::failed);
  EXPECT_EQ(states[4].stage, MemberStage::claimed);
  EXPECT_EQ(states[4].claim, 10);
  EXPECT_EQ(states[6].stage, MemberStage::waiting);
  EXPECT_EQ(states[1].stage, MemberStage::waiting) << "folder b does not exist yet";
  EXPECT_EQ(count_of(states, MemberStage::waiting), 5u);
  EXPECT_TRUE(states[6].has_folder);
  EXPECT_FALSE(states[0].has_folder);
}

TEST_F(ClaimTest, that_failed_leaves_a_message_that_is_harmless) {
  record_failure(run, {65, "bad \x1b[2J"});
  const MemberFailure failure = read_failure(run);
  EXPECT_EQ(failure.exit_code, 65);
  EXPECT_EQ(failure.message, "bad \\x1b[2J");
}

TEST_F(ClaimTest, that_failed_has_the_last_line_of_a_log_that_says_something) {
  std::ofstream(folder.path("log")) << "first\nlast\n \n\n";
  EXPECT_EQ(last_line_of(folder.path("log")), "last");
  touch(folder.path("empty"));
  EXPECT_EQ(last_line_of(folder.path("empty")), "");
}

TEST(DISABLED_JobOfAPool, ends_well) {}
TEST(DISABLED_JobOfAPool, ends_with_an_error) { FAIL() << "as expected"; }
TEST(DISABLED_JobOfAPool, takes_long) { std::this_thread::sleep_for(std::chrono::minutes(1)); }

Job job(const std::string& test, const std::string& log) {
  return {{"--gtest_also_run_disabled_tests", "--gtest_filter=DISABLED_JobOfAPool." + test}, log};
}

bool always() { return true; }

using Pool = test::FolderTest;

TEST_F(Pool, does_all_jobs_and_returns_those_that_failed) {
  const std::string good = folder.path("a/b/good.log"), bad = folder.path("bad.log");
  const auto failed = run_jobs({job("ends_well", good), job("ends_with_an_error", bad)}, "the test", always);
  ASSERT_EQ(failed.size(), 1u);
  EXPECT_EQ(failed[0].log, bad);
  EXPECT_EQ(failed[0].exit_code, 1);
  EXPECT_NE(io::read_text(bad).find("as expected"), std::string::npos);
  EXPECT_NE(io::read_text(good).find("1 test"), std::string::npos) << "its folder was created";
}

TEST_F(Pool, ends_its_jobs_where_it_is_not_to_go_on) {
  const std::vector<Job> jobs = {job("takes_long", folder.path("1.log")),
                                 job("takes_long", folder.path("2.log"))};
  const auto failed = run_jobs(jobs, "the test", [] { return false; });
  ASSERT_EQ(failed.size(), 2u) << "in parallel: both had begun";
  for (const FailedJob& each : failed) EXPECT_EQ(each.exit_code, 128 + SIGTERM);
}

TEST_F(Pool, passes_a_signal_on_and_says_that_it_was_stopped) {
  const std::vector<Job> jobs = {job("takes_long", folder.path("1.log"))};
  int asked = 0;
  const auto signalled = [&] { return ++asked > 1 || kill(getpid(), SIGTERM) == 0; };
  EXPECT_EQ(test::exit_code_of([&] { run_jobs(jobs, "the test", signalled); }), ExitCode::stopped);
  EXPECT_EQ(asked, 1);
}

// A batch system sends its signal to a whole tree of processes, and the parent passes it on: the job must not
// take that for a second signal, which ends it at once.
TEST_F(Pool, passes_a_signal_on_as_one_that_its_jobs_may_have_had_already) {
  sigset_t held;
  sigemptyset(&held);
  sigaddset(&held, SIGTERM);
  sigprocmask(SIG_BLOCK, &held, nullptr);
  const auto request_of = [&](const std::function<void()>& send) {
    send();
    siginfo_t signal{};
    sigwaitinfo(&held, &signal);
    return passed_on(signal);
  };
  EXPECT_EQ(request_of([] { pass_on_stop(getpid(), StopRequest::once); }), StopRequest::once);
  EXPECT_EQ(request_of([] { pass_on_stop(getpid(), StopRequest::at_once); }), StopRequest::at_once);
  EXPECT_EQ(request_of([] { kill(getpid(), SIGTERM); }), std::nullopt);
  sigprocmask(SIG_UNBLOCK, &held, nullptr);
}

// Other code may reap a child, or the parent may have ignored SIGCHLD.
TEST_F(Pool, does_not_wait_for_a_job_that_nobody_can_tell_the_end_of) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  const auto failed = run_jobs({job("ends_well", folder.path("1.log"))}, "the test", always);
  std::signal(SIGCHLD, before);
  ASSERT_EQ(failed.size(), 1u);
  EXPECT_EQ(failed[0].exit_code, 70);
}

TEST(Refusal, has_the_exit_code_of_the_first_and_names_all_logs) {
  EXPECT_EQ(
      test::refusal_of([] {
        refuse({{"a.log", 65, "what it said"}, {"b.log", 137}}, "left out");
      }),
      (test::Refusal{ExitCode::bad_data,
                     "2 runs ended with an error, left out; see\n"
                     "  a.log (exit code 65): what it said\n"
                     "  b.log (exit code 137, killed by signal 9, as by the system where memory runs out)"}));
  const auto code_after = [](int signal) {
    return test::exit_code_of([signal] { refuse({{"b.log", 128 + signal}}, ""); });
  };
  EXPECT_EQ(code_after(SIGKILL), ExitCode::stopped) << "no defect of the program: the command is repeated";
  EXPECT_EQ(code_after(SIGTERM), ExitCode::stopped);
  EXPECT_EQ(code_after(SIGSEGV), ExitCode::internal);
  EXPECT_EQ(code_after(SIGABRT), ExitCode::internal);
}

}  // namespace
}  // namespace talus::ensemble
