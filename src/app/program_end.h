#pragma once
/// End of the program: on errors, with a message and an exit code, even outside of main; and on the signals
/// that ask for it, SIGINT, SIGTERM, and SIGHUP unless it is ignored (nohup).

#include <csignal>

namespace talus::app {

/// Reports the current exception on stderr, and returns its exit code.
int report_exception();

/// Installs the handlers: the first signal asks the command to stop, and ends the program a third of a second
/// later in any case; another, at least a second after the first, ends it at once. Both end with
/// ExitCode::stopped. Signals within a second are repetitions: a batch system sends its signal to a whole
/// tree of processes, some of which also pass it on.
void end_on_signals();

/// Returns the flag that the first signal sets.
const volatile std::sig_atomic_t* stop_request();
bool asked_to_stop();

/// Throws Error(stopped) if a signal has requested a stop.
void stop_if_asked();

/// Scope in which the first signal only sets stop_request(), so that computed data can be committed, however
/// long that takes. A later signal still ends the program at once.
class CommitOnSignals {
 public:
  CommitOnSignals();
  ~CommitOnSignals();
  CommitOnSignals(const CommitOnSignals&) = delete;
  CommitOnSignals& operator=(const CommitOnSignals&) = delete;
};

/// Installs a handler of SIGUSR1 and returns the flag that it sets.
volatile std::sig_atomic_t* catch_checkpoint_signal();

}  // namespace talus::app
