#include "app/program_end.h"

#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "app/terminal.h"
#include "base/errors.h"
#include "base/sanitizers.h"
#include "io/file_in_use.h"

namespace talus::app {
namespace {

constexpr std::string_view out_of_memory =
    "talus: error: out of memory: use a smaller bed (bed.length, bed.depth)\n";

/// Reports a requested stop, which is not an error, in one plain sentence.
int report_stopped(std::string sentence) {
  if (!sentence.empty())
    sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
  print_error("%s.\n", sentence.c_str());
  return static_cast<int>(ExitCode::stopped);
}

int report(ExitCode code, const char* message) {
  print_error("talus: error: %s\n", message);
  return static_cast<int>(code);
}

/// Writes to stderr without allocating; safe in a signal handler.
void write_to_stderr(std::string_view text) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

int report_out_of_memory() {
  write_to_stderr(out_of_memory);
  return static_cast<int>(ExitCode::out_of_memory);
}

int report_malformed(std::string_view path) {
  write_to_stderr("talus: error: ");
  // visible() would allocate memory.
  for (const char& c : path) write_to_stderr(c >= ' ' && c <= '~' ? std::string_view(&c, 1) : "?");
  write_to_stderr(
      ": HDF5 crashes on this file: it is malformed, although its hash is right; restore it from a copy\n");
  return static_cast<int>(ExitCode::bad_data);
}

/// Ends the program on exceptions that main does not see: those of threads, or before main begins. There is
/// no exception if even the memory for one is missing.
[[noreturn]] void end_without_main() noexcept {
  if (std::current_exception()) _exit(report_exception());
  if (errno == ENOMEM) _exit(report_out_of_memory());
  _exit(report(ExitCode::internal, "ended for an unknown reason"));
}

/// Reports lack of memory at exit, because HDF5 calls exit(-1) if some of its allocations fail.
void report_exit_out_of_memory() {
  if (errno == ENOMEM) _exit(report_out_of_memory());
}

/// Whether a sanitizer reports crashes.
constexpr bool crashes_are_reported = sanitizes_addresses || sanitizes_threads;

/// Signals raised in HDF5 if other allocations of it fail, or if a file is malformed.
constexpr int crash_signals[] = {SIGSEGV, SIGBUS, SIGABRT};

/// Reports a crash as lack of memory if the last system error was ENOMEM, because errno stays until the next
/// error; otherwise as a malformed file if HDF5 is reading one. Any other crash takes its usual course and
/// leaves a core.
void report_crash(int signal) {
  if (errno == ENOMEM) _exit(report_out_of_memory());
  if (io::file_in_use != nullptr) _exit(report_malformed(io::file_in_use));
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// Installs the crash handler on a separate stack, because a crash may be an endless recursion.
void catch_crashes() {
  alignas(16) static char stack[16384];
  const stack_t other = {.ss_sp = stack, .ss_flags = 0, .ss_size = sizeof stack};
  sigaltstack(&other, nullptr);
  struct sigaction action = {};
  action.sa_handler = report_crash;
  action.sa_flags = SA_ONSTACK;
  for (const int signal : crash_signals) sigaction(signal, &action, nullptr);
}

/// Runs before all other initialisation.
[[gnu::constructor(101)]] void install_handlers() {
  std::set_terminate(end_without_main);
  std::atexit(report_exit_out_of_memory);
  if (!crashes_are_reported) catch_crashes();
}

}  // namespace

int report_exception() {
  try {
    throw;
  } catch (const LocatedError& error) {
    print_error("%s\n", error.what());
    return static_cast<int>(error.code());
  } catch (const Error& error) {
    if (error.code() == ExitCode::stopped) return report_stopped(error.what());
    return report(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return report_out_of_memory();
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::not_enough_memory) return report_out_of_memory();
    const bool no_thread = error.code() == std::errc::resource_unavailable_try_again;
    return report(no_thread ? ExitCode::out_of_memory : ExitCode::internal,
                  no_thread ? "the system cannot start more threads; use --threads 1" : error.what());
  } catch (const std::exception& error) {
    return report(ExitCode::internal, error.what());
  }
}

}  // namespace talus::app
