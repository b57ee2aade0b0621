#pragma once
/// A few threads that work through short tasks together.

#include <atomic>
#include <thread>
#include <type_traits>
#include <vector>

namespace talus {

/// The calling thread and size - 1 others. Made for tasks of some tens of microseconds: members wait for
/// each other by spinning for a moment, then sleeping. Running a task allocates nothing.
class ThreadTeam {
 public:
  /// Throws std::system_error where the system gives no more threads.
  explicit ThreadTeam(int size);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int size() const { return size_; }

  /// Runs task(member) on every member, member = 0 ... size - 1, and returns when all are done. `task` must
  /// not throw.
  template <class Task>
  void run(Task&& task) {
    using Callable = std::remove_reference_t<Task>;
    task_ = &task;
    call_ = [](void* callable, int member) { (*static_cast<Callable*>(callable))(member); };
    start();
  }

  /// To be called by every member from within a task: none goes on before all have come.
  void wait_for_all();

 private:
  void dismiss();
  void start();
  void work(int member);

  int size_;
  int spins_;
  std::atomic<int> arrived_{0};
  std::atomic<unsigned> round_{0};
  std::atomic<unsigned> task_number_{0};
  std::atomic<bool> leaving_{false};
  void* task_ = nullptr;
  void (*call_)(void*, int) = nullptr;
  std::vector<std::thread> threads_;
};

/// The part of 0 ... count - 1 that a member takes: [part_begin(member), part_begin(member + 1)).
inline int part_begin(int count, int member, int size) {
  return static_cast<int>(static_cast<long long>(count) * member / size);
}

/// Calls what(first, last) for parts that together are 0 ... count - 1: on each member of the team for its
/// own, or once where there is none. `what` must not throw.
template <class Do>
void share_out(ThreadTeam* team, std::size_t count, const Do& what) {
  if (team == nullptr) return what(std::size_t{0}, count);
  const std::size_t size = static_cast<std::size_t>(team->size());
  team->run([&what, count, size](int member) {
    const auto own = static_cast<std::size_t>(member);
    what(count * own / size, count * (own + 1) / size);
  });
}

/// Does two things that do not depend on each other: on two members of the team at once, or one after the
/// other where there are none. They must not throw.
template <class First, class Second>
void do_both(ThreadTeam* team, const First& first, const Second& second) {
  if (team == nullptr || team->size() == 1) {
    first();
    second();
    return;
  }
  team->run([&](int member) {
    if (member == 0) first();
    if (member == 1) second();
  });
}

}  // namespace talus
