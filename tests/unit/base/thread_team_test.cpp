#include "base/thread_team.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <system_error>
#include <vector>

#include "base/version.h"
#include "support/resource_limit.h"

namespace talus {
namespace {

/// Calls what(team) without a team, and with teams of several sizes.
template <class Do>
void with_teams(const Do& what) {
  what(nullptr);
  for (const int size : {1, 2, 3, 5}) {
    ThreadTeam team(size);
    what(&team);
  }
}

TEST(ThreadTeam, shares_out_each_of_many_once) {
  with_teams([](ThreadTeam* team) {
    for (const std::size_t count : {0, 1, 2, 3, 1000}) {
      std::vector<int> done(count, 0);
      distribute(team, count, [&done](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) ++done[i];
      });
      EXPECT_EQ(done, std::vector<int>(count, 1));
    }
  });
}

TEST(ThreadTeam, does_both_of_two_things_once) {
  with_teams([](ThreadTeam* team) {
    for (int round = 1; round <= 3; ++round) {
      std::array<int, 2> done{};
      run_both(
          team, [&done] { ++done[0]; }, [&done] { ++done[1]; });
      EXPECT_EQ(done, (std::array<int, 2>{1, 1}));
    }
  });
}

TEST(ThreadTeam, waits_for_all_between_two_parts_of_a_task) {
  ThreadTeam team(3);
  for (int round = 0; round < 100; ++round) {
    std::array<int, 3> written{}, sums{};
    team.run([&](int member) {
      written[static_cast<std::size_t>(member)] = member + 1;
      team.wait_for_all();
      sums[static_cast<std::size_t>(member)] = std::accumulate(written.begin(), written.end(), 0);
    });
    EXPECT_EQ(sums, (std::array<int, 3>{6, 6, 6}));
  }
}

// Threads already started must be joined, or their destructors would end the program.
TEST(ThreadTeam, that_the_system_has_no_threads_for_is_an_error) {
  if (sanitizes_addresses || test::sanitizes_threads)
    GTEST_SKIP() << "sanitizers reserve memory beyond any limit";
  const auto make = [] {
    std::ifstream pages("/proc/self/statm");
    rlim_t size = 0;
    pages >> size;
    size =
        size * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + (rlim_t{64} << 20);  // stacks for a few threads
    const rlimit limit = {size, size};
    setrlimit(RLIMIT_AS, &limit);
    try {
      ThreadTeam team(200);
    } catch (const std::system_error&) {
      std::_Exit(3);
    }
    std::_Exit(0);
  };
  EXPECT_EXIT(make(), testing::ExitedWithCode(3), "");
}

}  // namespace
}  // namespace talus
