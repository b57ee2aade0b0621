/// Tasks executed in a background thread.

#include "pictures/background_tasks.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <vector>

#include "base/errors.h"

namespace talus::pictures {
namespace {

TEST(BackgroundTasks, are_done_in_order_on_one_other_thread) {
  std::vector<int> done;
  std::vector<std::thread::id> threads;
  BackgroundTasks tasks(2);
  for (int k = 0; k < 50; ++k)
    tasks.post([&, k] {
      done.push_back(k);
      threads.push_back(std::this_thread::get_id());
    });
  tasks.finish();
  ASSERT_EQ(done.size(), 50u);
  for (int k = 0; k < 50; ++k) {
    EXPECT_EQ(done[static_cast<std::size_t>(k)], k);
    EXPECT_EQ(threads[static_cast<std::size_t>(k)], threads[0]);
  }
  EXPECT_NE(threads[0], std::this_thread::get_id());
}

TEST(BackgroundTasks, are_busy_until_the_last_is_done) {
  BackgroundTasks tasks(2);
  EXPECT_FALSE(tasks.busy());
  std::promise<void> go;
  tasks.post([&] { go.get_future().wait(); });
  EXPECT_TRUE(tasks.busy());
  go.set_value();
  tasks.finish();
  EXPECT_FALSE(tasks.busy());
}

TEST(BackgroundTasks, no_more_wait_than_may) {
  std::atomic<int> held = 0, most = 0;
  {
    BackgroundTasks tasks(3);
    for (int k = 0; k < 200; ++k) {
      tasks.post([&] { --held; });
      most = std::max(most.load(), ++held);
    }
  }
  EXPECT_LE(most, 3 + 2) << "those waiting, the one in progress, and the one just posted";
}

TEST(BackgroundTasks, what_one_throws_is_thrown_on_and_ends_them) {
  bool done = false;
  BackgroundTasks tasks(2);
  tasks.post([] { throw Error(ExitCode::io_error, "the disk is full"); });
  EXPECT_THROW(tasks.finish(), Error);
  EXPECT_THROW(tasks.post([&done] { done = true; }), Error);
  EXPECT_THROW(tasks.finish(), Error);
  EXPECT_FALSE(done);
}

TEST(BackgroundTasks, those_that_wait_at_the_end_are_done) {
  int done = 0;
  {
    BackgroundTasks tasks(2);
    for (int k = 0; k < 4; ++k) tasks.post([&done] { ++done; });
  }
  EXPECT_EQ(done, 4);
}

TEST(BackgroundTasks, those_that_wait_can_be_dropped) {
  std::promise<void> permission;
  int done = 0;
  {
    BackgroundTasks tasks(3);
    tasks.post([&permission] { permission.get_future().wait(); });
    for (int k = 0; k < 2; ++k) tasks.post([&done] { ++done; });
    tasks.drop();
    tasks.post([&done] { done += 10; });
    permission.set_value();
  }
  EXPECT_EQ(done, 10);
}

/// ThreadSanitizer checks here that no task is dropped while the thread takes it.
TEST(BackgroundTasks, are_dropped_while_others_are_taken) {
  std::atomic<int> done = 0;
  BackgroundTasks tasks(3);
  for (int k = 0; k < 2000; ++k) {
    tasks.post([&done] { ++done; });
    if (k % 3 == 0) tasks.drop();
  }
  tasks.finish();
  EXPECT_GE(done, 1);
  EXPECT_LE(done, 2000);
}

}  // namespace
}  // namespace talus::pictures
