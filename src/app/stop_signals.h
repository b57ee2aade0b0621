#pragma once
/// Signals that ask the program to end: SIGINT, SIGTERM, and SIGHUP where it is not ignored (nohup).

#include <csignal>

namespace talus::app {

/// From now on the first of these signals asks the command to stop, and ends the program a third of a second
/// later, whatever it computes or waits for; the second ends it at once. Both with ExitCode::stopped.
void end_on_signals();

/// Set by the first signal.
const volatile std::sig_atomic_t* stop_request();
bool asked_to_stop();

/// Throws Error(stopped) where a signal has asked for it.
void stop_if_asked();

/// While it lives the first signal only sets stop_request(): what is computed can be committed, however long
/// that takes. The second ends the program at once all the same.
class CommitOnSignals {
 public:
  CommitOnSignals();
  ~CommitOnSignals();
  CommitOnSignals(const CommitOnSignals&) = delete;
  CommitOnSignals& operator=(const CommitOnSignals&) = delete;
};

/// Catches SIGUSR1 from now on and returns the flag that it sets.
volatile std::sig_atomic_t* catch_checkpoint_signal();

}  // namespace talus::app
