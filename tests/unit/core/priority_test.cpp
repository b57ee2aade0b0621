#include "core/priority.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

namespace talus {
namespace {

int nice_value() { return getpriority(PRIO_PROCESS, static_cast<id_t>(gettid())); }

TEST(Priority, of_a_thread_and_those_that_it_begins_alone) {
  const int before = nice_value();
  int within = before, of_its_thread = before;
  std::thread([&] {
    give_way();
    within = nice_value();
    std::thread([&] { of_its_thread = nice_value(); }).join();
  }).join();
  EXPECT_EQ(within, std::min(19, before + 15));
  EXPECT_EQ(of_its_thread, within);
  EXPECT_EQ(nice_value(), before) << "the thread that began it is as urgent as before";
}

}  // namespace
}  // namespace talus
