#include "base/thread_team.h"

namespace talus {
namespace {

/// Waits until the value differs from `old`: spins for some tens of microseconds, because tasks end at nearly
/// the same time, and then sleeps in the kernel.
void wait_while_equal(const std::atomic<unsigned>& value, unsigned old, int spins) {
  for (int spin = 0; spin < spins; ++spin) {
    if (value.load(std::memory_order_acquire) != old) return;
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
  value.wait(old, std::memory_order_acquire);
}

/// Returns the number of spins. Spinning pays only if every member has its own processor.
int spins_for(int size) { return size <= static_cast<int>(std::thread::hardware_concurrency()) ? 2000 : 0; }

}  // namespace

ThreadTeam::ThreadTeam(int size) : size_(size), spins_(spins_for(size)) {
  threads_.reserve(static_cast<std::size_t>(size));
  try {
    for (int member = 1; member < size; ++member) threads_.emplace_back([this, member] { work(member); });
  } catch (...) {  // no more threads: those already started must not outlive the team
    dismiss();
    throw;
  }
}

ThreadTeam::~ThreadTeam() { dismiss(); }

void ThreadTeam::dismiss() {
  leaving_.store(true);
  task_number_.fetch_add(1);
  task_number_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadTeam::start() {
  task_number_.fetch_add(1, std::memory_order_release);
  task_number_.notify_all();
  call_(task_, 0);
  wait_for_all();
}

void ThreadTeam::wait_for_all() {
  const unsigned round = round_.load(std::memory_order_acquire);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == size_) {
    arrived_.store(0, std::memory_order_relaxed);
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
  } else {
    wait_while_equal(round_, round, spins_);
  }
}

void ThreadTeam::work(int member) {
  unsigned seen = 0;
  for (;;) {
    wait_while_equal(task_number_, seen, spins_);
    seen = task_number_.load(std::memory_order_acquire);
    if (leaving_.load()) return;
    call_(task_, member);
    wait_for_all();
  }
}

}  // namespace talus
