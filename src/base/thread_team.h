#pragma once
/// A few threads that process short tasks together.

#include <atomic>
#include <thread>
#include <type_traits>
#include <vector>

namespace talus {

/// A team of the calling thread and size - 1 others, for tasks of some tens of microseconds. Members wait for
/// each other by spinning for a moment, and then sleeping. Running a task allocates nothing.
class ThreadTeam {
 public:
  /// Throws std::system_error if the system provides no more threads.
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

  /// Waits until all members have called this function. Every member must call it from within a task.
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

/// Returns the first item of a member; its part of 0 ... count - 1 is
/// [part_begin(member), part_begin(member + 1)).
inline int part_begin(int count, int member, int size) {
  return static_cast<int>(static_cast<long long>(count) * member / size);
}

/// Calls what(first, last) for parts that together are 0 ... count - 1: on each member of the team for its
/// own part, or once without a team. `what` must not throw.
template <class Do>
void distribute(ThreadTeam* team, std::size_t count, const Do& what) {
  if (team == nullptr) return what(std::size_t{0}, count);
  const std::size_t size = static_cast<std::size_t>(team->size());
  team->run([&what, count, size](int member) {
    const std::size_t own = member;
    what(count * own / size, count * (own + 1) / size);
  });
}

/// Calls two independent functions, simultaneously on two members of the team, or one after the other without
/// a team. They must not throw.
template <class First, class Second>
void run_both(ThreadTeam* team, const First& first, const Second& second) {
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
