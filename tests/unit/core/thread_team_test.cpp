#include "core/thread_team.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <vector>

namespace talus {
namespace {

/// Calls what(team) without a team, and with those of some sizes.
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
      share_out(team, count, [&done](std::size_t first, std::size_t last) {
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
      do_both(
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

}  // namespace
}  // namespace talus
