#pragma once
/// Threads, forks and signals where Python calls Talus: code that runs without the interpreter, what a forked
/// child may still use, and Ctrl-C in threads other than the main one.

#include <pybind11/pybind11.h>

#include <atomic>
#include <cstdint>
#include <optional>

namespace talus {

/// Numbers of threads that step, or use files, without holding the interpreter, and of those that draw; the
/// former must end before the interpreter does.
extern std::atomic<int> steps_under_way, draws_under_way;
extern std::atomic<bool> interpreter_ends;

/// Prepares for forked children, which lack the other threads. Mesa draws without threads of its own, because
/// a child would wait for them when it draws or ends.
void survive_forks();

/// Throw Error(unavailable) in a forked child that cannot use HDF5, or cannot draw, because its parent had
/// another thread that did. Call before files are used, or something is drawn.
void require_files();
void require_drawing();

/// Increments a counter during its lifetime.
class Count {
 public:
  explicit Count(std::atomic<int>& of) : of_(of) { ++of_; }
  ~Count() { --of_; }
  Count(const Count&) = delete;
  Count& operator=(const Count&) = delete;

 private:
  std::atomic<int>& of_;
};

bool is_main_thread();

/// Keeps a daemon thread, as Python does, if the interpreter ends.
void wait_if_the_interpreter_ends();

/// Runs `work` without holding the interpreter: another thread may be in h5py with the lock of HDF5, and need
/// the interpreter. A thread without it could never continue once the interpreter ends, so it is waited for,
/// and from then on the main thread, the only one left, does not let go.
template <typename Work>
auto without_interpreter(Work&& work) {
  wait_if_the_interpreter_ends();
  std::optional<Count> count;
  std::optional<pybind11::gil_scoped_release> let_go;
  if (!interpreter_ends) {
    count.emplace(steps_under_way);
    let_go.emplace();
  }
  return work();
}

/// Calls a function that draws.
template <typename Draw>
auto while_drawing(Draw&& draw) {
  require_drawing();
  const Count count(draws_under_way);
  return draw();
}

/// Throws what Python has raised for a signal, such as KeyboardInterrupt; in another thread than the main
/// one, KeyboardInterrupt if the main thread has been interrupted while this thread was busy with
/// simulations, or waits for this thread because of an interrupt. Call while holding the interpreter.
void raise_if_interrupted();

/// A call that steps, in a thread other than the main one. A thread whose last call ended less than a second
/// ago is still busy with simulations.
class AttentiveCall {
 public:
  AttentiveCall();
  ~AttentiveCall();
  AttentiveCall(const AttentiveCall&) = delete;
  AttentiveCall& operator=(const AttentiveCall&) = delete;
};

}  // namespace talus
