#include "app/program_end.h"

#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "app/terminal.h"
#include "base/child_program.h"
#include "base/errors.h"
#include "base/output_file.h"

namespace talus::app {
namespace {

int report(ExitCode code, const char* message) {
  print_error("talus: error: {}\n", message);
  return static_cast<int>(code);
}

/// Reports lack of memory without allocating any.
int report_out_of_memory() {
  constexpr char text[] = "talus: error: out of memory: use a smaller bed (bed.length, bed.depth)\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text, sizeof text - 1);
  return static_cast<int>(ExitCode::out_of_memory);
}

/// Ends the program on exceptions that main does not see: those of threads, or before main begins. There is
/// no exception if even the memory for one is missing.
[[noreturn]] void end_without_main() noexcept {
  if (std::current_exception()) _exit(report_exception());
  if (errno == ENOMEM) _exit(report_out_of_memory());
  std::abort();
}

/// Runs before all other initialisation. HDF5 calls exit(-1) if some of its allocations fail.
[[gnu::constructor(101)]] void install_handlers() {
  std::set_terminate(end_without_main);
  std::atexit([] {
    if (errno == ENOMEM) _exit(report_out_of_memory());
  });
}

}  // namespace

int report_exception() {
  try {
    throw;
  } catch (const LocatedError& error) {
    print_error("{}\n", error.what());
    return static_cast<int>(error.code());
  } catch (const Error& error) {
    if (error.code() != ExitCode::stopped) return report(error.code(), error.what());
    std::string sentence = error.what();  // a requested stop is not an error
    if (!sentence.empty())
      sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
    print_error("{}.\n", sentence);
    return static_cast<int>(ExitCode::stopped);
  } catch (const std::bad_alloc&) {
    return report_out_of_memory();
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::not_enough_memory) return report_out_of_memory();
    if (error.code() == std::errc::resource_unavailable_try_again)
      return report(ExitCode::out_of_memory, "the system cannot start more threads; use --threads 1");
    return report(ExitCode::internal, error.what());
  } catch (const std::exception& error) {
    return report(ExitCode::internal, error.what());
  }
}

namespace {

constexpr const char* sentence = "stopped; unfinished results are not kept";

volatile std::sig_atomic_t stop_requested = 0;
volatile std::sig_atomic_t commits_first = 0;
volatile std::sig_atomic_t checkpoint_requested = 0;

void set_alarm(int microseconds) {
  const itimerval once = {{0, 0}, {0, microseconds}};
  setitimer(ITIMER_REAL, &once, nullptr);
}

/// Monotonic time of the first signal, ns; 0 before it.
std::atomic<std::int64_t> first_signal = 0;

std::int64_t now() {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{1'000'000'000} * time.tv_sec + time.tv_nsec;
}

/// Whether a signal after the first ends the process at once, as every file is complete at any time.
bool ends_at_once(const siginfo_t& signal, std::int64_t since_first) {
  if (const auto request = passed_on(signal)) return *request == StopRequest::at_once;
  return static_cast<double>(since_first) >= 1e9 * repeats_end;
}

/// Handles the first signal as a request to stop.
void handle_stop(int, siginfo_t* signal, void*) {
  const std::int64_t time = now();
  std::int64_t first = 0;
  if (!first_signal.compare_exchange_strong(first, time)) {
    if (ends_at_once(*signal, time - first)) _exit(static_cast<int>(ExitCode::stopped));
    return;
  }
  stop_requested = 1;
  if (commits_first == 0) set_alarm(300'000);  // a command that checks stop_request() can clean up until then
}

void handle_alarm(int) {
  constexpr std::string_view text = "Stopped; unfinished results are not kept.\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
  remove_unfinished_files();
  _exit(static_cast<int>(ExitCode::stopped));
}

void handle_checkpoint(int) { checkpoint_requested = 1; }

void catch_signal(int signal, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

void catch_stop(int signal) {
  struct sigaction action = {};
  action.sa_sigaction = handle_stop;
  action.sa_flags = SA_RESTART | SA_SIGINFO;
  sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal) {
  struct sigaction action = {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void end_on_signals() {
  catch_signal(SIGALRM, handle_alarm);
  for (const int signal : {SIGINT, SIGTERM}) catch_stop(signal);
  if (!is_ignored(SIGHUP)) catch_stop(SIGHUP);
}

const volatile std::sig_atomic_t* stop_request() { return &stop_requested; }

bool asked_to_stop() { return stop_requested != 0; }

void stop_if_asked() {
  if (asked_to_stop()) throw Error(ExitCode::stopped, sentence);
}

CommitOnSignals::CommitOnSignals() {
  commits_first = 1;
  set_alarm(0);
}

CommitOnSignals::~CommitOnSignals() { commits_first = 0; }

volatile std::sig_atomic_t* catch_checkpoint_signal() {
  catch_signal(SIGUSR1, handle_checkpoint);
  return &checkpoint_requested;
}

}  // namespace talus::app
