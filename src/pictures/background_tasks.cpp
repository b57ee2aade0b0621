#include "pictures/background_tasks.h"

namespace talus::pictures {

BackgroundTasks::BackgroundTasks(std::size_t max_waiting)
    : max_waiting_(max_waiting), thread_([this] { work(); }) {}

BackgroundTasks::~BackgroundTasks() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void BackgroundTasks::post(std::function<void()> task) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return waiting_.size() < max_waiting_ || failure_; });
  throw_failure();
  waiting_.push_back(std::move(task));
  changed_.notify_all();
}

bool BackgroundTasks::busy() const {
  const std::lock_guard lock(mutex_);
  return working_ || !waiting_.empty();
}

void BackgroundTasks::drop() {
  const std::lock_guard lock(mutex_);
  waiting_.clear();
}

void BackgroundTasks::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return (waiting_.empty() && !working_) || failure_; });
  throw_failure();
}

void BackgroundTasks::throw_failure() {
  if (failure_) std::rethrow_exception(failure_);
}

void BackgroundTasks::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ended_ || !waiting_.empty(); });
    if (waiting_.empty() || failure_) return;
    std::function<void()> task = std::move(waiting_.front());
    waiting_.pop_front();
    working_ = true;
    lock.unlock();
    std::exception_ptr failure;
    try {
      task();
    } catch (...) {
      failure = std::current_exception();
    }
    task = nullptr;  // release the task's resources before the lock is acquired
    lock.lock();
    working_ = false;
    failure_ = failure;
    changed_.notify_all();
  }
}

}  // namespace talus::pictures
