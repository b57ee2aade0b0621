#pragma once
/// A thread beside this one that does what it is given, in order.

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace talus::pictures {

class BackgroundTasks {
 public:
  /// `most_waiting` tasks may wait; so what they hold stays within bounds.
  explicit BackgroundTasks(std::size_t most_waiting);
  /// Does what is waiting; errors are lost: call finish before.
  ~BackgroundTasks();
  BackgroundTasks(const BackgroundTasks&) = delete;
  BackgroundTasks& operator=(const BackgroundTasks&) = delete;

  /// Waits while as many are waiting as may. Throws what an earlier task threw; none is done after that.
  void post(std::function<void()> task);

  /// Whether there is anything to do now.
  bool busy() const;

  /// Forgets those that are waiting.
  void drop();

  /// Waits until all are done. Throws as post does.
  void finish();

 private:
  void work();
  void throw_failure();

  std::size_t most_waiting_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  bool working_ = false;
  bool ended_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace talus::pictures
