/// Pool of processes, which are instances of this test program that run one test each.

#include "ensemble/pool.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

#include "base/child_program.h"
#include "base/errors.h"
#include "io/durable_file.h"
#include "support/exit_code.h"
#include "support/temporary_folder.h"

namespace talus::ensemble {
namespace {

TEST(DISABLED_JobOfAPool, ends_well) {}
TEST(DISABLED_JobOfAPool, ends_with_an_error) { FAIL() << "as expected"; }
TEST(DISABLED_JobOfAPool, takes_long) { std::this_thread::sleep_for(std::chrono::minutes(1)); }

Job job(const std::string& test, const std::string& log) {
  return {{"--gtest_also_run_disabled_tests", "--gtest_filter=DISABLED_JobOfAPool." + test}, log};
}

bool always() { return true; }

TEST(Pool, does_all_jobs_and_returns_those_that_failed) {
  const test::TemporaryFolder folder;
  const std::string good = folder.path("a/b/good.log"), bad = folder.path("bad.log");
  const auto failed = run_jobs({job("ends_well", good), job("ends_with_an_error", bad)}, "the test", always);
  ASSERT_EQ(failed.size(), 1u);
  EXPECT_EQ(failed[0].log, bad);
  EXPECT_EQ(failed[0].exit_code, 1);
  EXPECT_NE(io::read_text(bad).find("as expected"), std::string::npos);
  EXPECT_NE(io::read_text(good).find("1 test"), std::string::npos) << "its folder was created";
}

TEST(Pool, ends_its_jobs_where_it_is_not_to_go_on) {
  const test::TemporaryFolder folder;
  const std::vector<Job> jobs = {job("takes_long", folder.path("1.log")),
                                 job("takes_long", folder.path("2.log"))};
  const auto failed = run_jobs(jobs, "the test", [] { return false; });
  ASSERT_EQ(failed.size(), 2u) << "in parallel: both had begun";
  for (const FailedJob& each : failed) EXPECT_EQ(each.exit_code, 128 + SIGTERM);
}

TEST(Pool, passes_a_signal_on_and_says_that_it_was_stopped) {
  const test::TemporaryFolder folder;
  const std::vector<Job> jobs = {job("takes_long", folder.path("1.log"))};
  int asked = 0;
  const auto signalled = [&] { return ++asked > 1 || kill(getpid(), SIGTERM) == 0; };
  EXPECT_EQ(test::exit_code_of([&] { run_jobs(jobs, "the test", signalled); }), ExitCode::stopped);
  EXPECT_EQ(asked, 1);
}

// A batch system sends its signal to a whole tree of processes, and the parent passes it on: the job must not
// take that for a second signal, which ends it at once.
TEST(Pool, passes_a_signal_on_as_one_that_its_jobs_may_have_had_already) {
  const test::TemporaryFolder folder;
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
TEST(Pool, does_not_wait_for_a_job_that_nobody_can_tell_the_end_of) {
  const test::TemporaryFolder folder;
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  const auto failed = run_jobs({job("ends_well", folder.path("1.log"))}, "the test", always);
  std::signal(SIGCHLD, before);
  ASSERT_EQ(failed.size(), 1u);
  EXPECT_EQ(failed[0].exit_code, 70);
}

TEST(Refusal, has_the_exit_code_of_the_first_and_names_all_logs) {
  try {
    refuse({{"a.log", 65, "what it said"}, {"b.log", 137}}, "left out");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    EXPECT_STREQ(error.what(),
                 "2 runs ended with an error, left out; see\n"
                 "  a.log (exit code 65): what it said\n"
                 "  b.log (exit code 137, killed by signal 9, as by the system where memory runs out)");
  }
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
