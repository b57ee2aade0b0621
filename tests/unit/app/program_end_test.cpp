/// Ends of the program outside main: lack of memory is reported, and any other crash stays a crash.

#include "app/program_end.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "base/errors.h"
#include "base/sanitizers.h"

namespace talus::app {
namespace {

constexpr bool sanitizers_report_crashes = sanitizes_addresses || sanitizes_threads;
const auto out_of_memory = testing::ExitedWithCode(71);

/// Returns the exit code of an exception caught by main.
template <typename Exception>
int code_of(const Exception& exception) {
  try {
    throw exception;
  } catch (...) {
    return report_exception();
  }
}

TEST(ProgramEnd, of_an_exception_is_its_exit_code) {
  EXPECT_EQ(code_of(Error(ExitCode::missing_input, "no such file")), 66);
  EXPECT_EQ(code_of(std::bad_alloc()), 71);
  EXPECT_EQ(code_of(std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again))), 71);
  EXPECT_EQ(
      code_of(std::filesystem::filesystem_error("", std::make_error_code(std::errc::not_enough_memory))), 71);
  EXPECT_EQ(code_of(std::runtime_error("a defect")), 70);
}

TEST(ProgramEnd, on_request_is_a_plain_sentence) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(code_of(Error(ExitCode::stopped, "stopped at 12.250 deg; talus run --resume a.h5 continues")),
            75);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "Stopped at 12.250 deg; talus run --resume a.h5 continues.\n");
}

TEST(ProgramEnd, of_another_thread_is_that_of_its_exception) {
  const auto in_thread = [] { std::thread([] { throw Error(ExitCode::io_error, "no space"); }).join(); };
  EXPECT_EXIT(in_thread(), testing::ExitedWithCode(74), "talus: error: no space");
}

void crash_after(int error, int signal) {
  errno = error;
  std::raise(signal);
}

TEST(ProgramEnd, of_a_crash_after_a_failed_allocation_is_that_of_missing_memory) {
  if (sanitizers_report_crashes) GTEST_SKIP() << "crashes belong to the sanitizer";
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT})
    EXPECT_EXIT(crash_after(ENOMEM, signal), out_of_memory, "talus: error: out of memory") << signal;
}

TEST(ProgramEnd, of_another_crash_is_the_crash) {
  if (sanitizers_report_crashes) GTEST_SKIP() << "crashes belong to the sanitizer";
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT})
    EXPECT_EXIT(crash_after(0, signal), testing::KilledBySignal(signal), "") << signal;
}

/// The result depends on the entire stack, so that the compiler cannot turn the recursion into a loop.
int sink(volatile int* above) {
  if (*above < 0) return 0;
  volatile int here[1024] = {*above};
  return sink(here) + here[512];
}

TEST(ProgramEnd, of_a_recursion_without_end_is_told_from_a_stack_of_its_own) {
  if (sanitizers_report_crashes) GTEST_SKIP() << "crashes belong to the sanitizer";
  const auto recurse = [](int error) {
    volatile int top = 0;
    errno = error;
    sink(&top);
  };
  EXPECT_EXIT(recurse(ENOMEM), out_of_memory, "talus: error: out of memory");
  EXPECT_EXIT(recurse(0), testing::KilledBySignal(SIGSEGV), "");
}

TEST(ProgramEnd, by_exit_or_terminate_after_a_failed_allocation_is_that_of_missing_memory) {
  const auto leave = [] {
    errno = ENOMEM;
    std::exit(-1);  // HDF5 does this
  };
  const auto terminate = [](int error) {
    errno = error;
    std::terminate();
  };
  EXPECT_EXIT(leave(), out_of_memory, "talus: error: out of memory");
  EXPECT_EXIT(terminate(ENOMEM), out_of_memory, "talus: error: out of memory");
  EXPECT_EXIT(terminate(0), testing::ExitedWithCode(70), "ended for an unknown reason");
}

}  // namespace
}  // namespace talus::app
