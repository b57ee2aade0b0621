#include "interpreter.h"

#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "base/errors.h"

namespace py = pybind11;

namespace talus {

std::atomic<int> steps_under_way = 0, draws_under_way = 0;
std::atomic<bool> interpreter_ends = false;

namespace {

/// Flags of a forked child whose parent had another thread that was drawing, or was in a simulation, which
/// may have been writing: the locks of Mesa and HDF5 stay as they were at the fork.
bool cannot_draw = false, cannot_use_files = false;

// Python delivers signals to the main thread only. Other threads compare the time of the last SIGINT with
// their own.

using Nanoseconds = std::int64_t;
constexpr Nanoseconds one_second = 1'000'000'000;
std::atomic<Nanoseconds> interrupted_at = 0;  ///< time of the last SIGINT
void (*handler_of_python)(int) = nullptr;     ///< handler of SIGINT that Python has set

Nanoseconds now() {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * one_second + time.tv_nsec;
}

void note_interrupt(int number) {
  interrupted_at = now();
  handler_of_python(number);
}

/// Has Python's handler of SIGINT note the time as well. Handlers in Python are unaffected. Python replaces
/// this when it sets one, until the next call; handlers of other libraries are left alone. Call while holding
/// the interpreter.
void watch_interrupts() {
  struct sigaction action {};
  if (::sigaction(SIGINT, nullptr, &action) != 0 || (action.sa_flags & SA_SIGINFO) != 0) return;
  if (action.sa_handler == SIG_DFL || action.sa_handler == SIG_IGN) return;
  if (handler_of_python == nullptr) handler_of_python = action.sa_handler;
  if (action.sa_handler != handler_of_python) return;
  action.sa_handler = note_interrupt;
  ::sigaction(SIGINT, &action, nullptr);
}

/// Simulations that a thread other than the main one steps.
struct Attention {
  Nanoseconds since = 0;  ///< interrupts from this time on are meant for it
  Nanoseconds left = 0;   ///< end of its last call
  Nanoseconds asked = 0;  ///< time at which the state of the main thread was last looked at
};
thread_local Attention attention;

}  // namespace

void survive_forks() {
  ::setenv("LP_NUM_THREADS", "0", 0);
  ::pthread_atfork(nullptr, nullptr, [] {
    cannot_draw = cannot_draw || draws_under_way > 0;
    cannot_use_files = cannot_use_files || steps_under_way > 0;
    steps_under_way = draws_under_way = 0;
  });
}

void require_files() {
  if (cannot_use_files)
    throw Error(ExitCode::unavailable,
                "this process was forked while another thread was using Talus, and can neither read nor "
                "record runs: start it with the method \"spawn\" of multiprocessing");
}

void require_drawing() {
  if (cannot_draw)
    throw Error(ExitCode::unavailable,
                "this process was forked while another thread was drawing, and cannot draw: start it with "
                "the method \"spawn\" of multiprocessing");
}

bool is_main_thread() { return ::gettid() == ::getpid(); }

void wait_if_the_interpreter_ends() {
  if (!interpreter_ends || is_main_thread()) return;
  const py::gil_scoped_release let_go;
  while (true) ::pause();
}

void raise_if_interrupted() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (is_main_thread()) return;
  constexpr Nanoseconds pause = one_second / 20;
  watch_interrupts();
  const Nanoseconds time = now(), at = interrupted_at;
  const py::module_ interrupts = py::module_::import("talus.interrupts");
  bool ends = false;
  if (at >= attention.since) {
    attention.since = at + 1;
    ends = interrupts.attr("are_raised")().cast<bool>();
  }
  if (!ends && time - attention.asked >= pause) {
    attention.asked = time;
    ends = interrupts.attr("end_the_main_thread")().cast<bool>();
  }
  if (!ends) return;
  PyErr_SetNone(PyExc_KeyboardInterrupt);
  throw py::error_already_set();
}

AttentiveCall::AttentiveCall() {
  if (is_main_thread()) return;
  if (now() - attention.left > one_second) attention.since = now();
  raise_if_interrupted();
}

AttentiveCall::~AttentiveCall() {
  if (!is_main_thread()) attention.left = now();
}

}  // namespace talus
