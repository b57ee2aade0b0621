#include "app/stop_signals.h"

#include <sys/time.h>
#include <unistd.h>

#include <string_view>

#include "base/errors.h"

namespace talus::app {
namespace {

constexpr const char* sentence = "stopped; unfinished results are not kept";

volatile std::sig_atomic_t stop_requested = 0;
volatile std::sig_atomic_t commits_first = 0;
volatile std::sig_atomic_t checkpoint_requested = 0;

void set_alarm(int microseconds) {
  const itimerval once = {{0, 0}, {0, microseconds}};
  setitimer(ITIMER_REAL, &once, nullptr);
}

/// Starts the timer, long enough for a command that checks stop_request() to clean up.
void arm() { set_alarm(300'000); }

/// Handles the first signal as a request to stop; the second ends the process at once (every file is complete
/// at any time).
void handle_stop(int) {
  if (stop_requested != 0) _exit(static_cast<int>(ExitCode::stopped));
  stop_requested = 1;
  if (commits_first == 0) arm();
}

void handle_alarm(int) {
  constexpr std::string_view text = "Stopped; unfinished results are not kept.\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
  _exit(static_cast<int>(ExitCode::stopped));
}

void handle_checkpoint(int) { checkpoint_requested = 1; }

void catch_signal(int signal, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

bool is_ignored(int signal) {
  struct sigaction action = {};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void end_on_signals() {
  catch_signal(SIGALRM, handle_alarm);
  for (const int signal : {SIGINT, SIGTERM}) catch_signal(signal, handle_stop);
  if (!is_ignored(SIGHUP)) catch_signal(SIGHUP, handle_stop);
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
