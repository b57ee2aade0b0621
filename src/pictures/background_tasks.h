#pragma once
/// A thread that executes tasks in order.

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace talus::pictures {

class BackgroundTasks {
 public:
  /// Starts the thread. At most `max_waiting` tasks may wait, which bounds their memory.
  explicit BackgroundTasks(std::size_t max_waiting);
  /// Executes the waiting tasks. Errors are lost, so call finish first.
  ~BackgroundTasks();
  BackgroundTasks(const BackgroundTasks&) = delete;
  BackgroundTasks& operator=(const BackgroundTasks&) = delete;

  /// Adds a task; blocks while the maximum number is waiting. Throws what an earlier task threw; no further
  /// task is then executed.
  void post(std::function<void()> task);

  /// Whether a task is running or waiting.
  bool busy() const;

  /// Discards the waiting tasks.
  void drop();

  /// Waits until all tasks are done. Throws the errors of post.
  void finish();

 private:
  void work();
  void throw_failure();

  std::size_t max_waiting_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  bool working_ = false;
  bool ended_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace talus::pictures
