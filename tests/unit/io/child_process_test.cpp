/// Pieces of work that end their process take no others with them.

#include "io/child_process.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "core/errors.h"

namespace talus {
namespace {

/// The pieces that were taken of those that return their number, and else abort, fail, or fall silent.
std::vector<std::size_t> taken(std::size_t count, const std::function<void(std::size_t)>& harm) {
  std::vector<std::size_t> numbers;
  in_child_processes("work", 0,
                     {count,
                      [&](std::size_t k) {
                        harm(k);
                        return std::vector<std::byte>(k, std::byte{7});
                      },
                      [&](std::size_t k, const std::vector<std::byte>& bytes) {
                        EXPECT_EQ(bytes, std::vector<std::byte>(k, std::byte{7}));
                        numbers.push_back(k);
                      }});
  return numbers;
}

TEST(ChildProcesses, lose_only_the_piece_that_ends_one) {
  const auto harm = [](std::size_t k) {
    if (k == 0 || k == 3) std::abort();
    if (k == 4) throw Error(ExitCode::bad_data, "not this one");
    if (k == 5) std::_Exit(0);
  };
  EXPECT_EQ(taken(8, harm), (std::vector<std::size_t>{1, 2, 6, 7}));
}

TEST(ChildProcesses, are_not_many) {
  EXPECT_TRUE(taken(1000, [](std::size_t) { std::abort(); }).empty());
  const auto first = [](std::size_t k) {
    if (k < static_cast<std::size_t>(most_children)) std::abort();
  };
  EXPECT_TRUE(taken(20, first).empty());
}

TEST(ChildProcesses, do_much_in_one) {
  const std::vector<std::size_t> numbers = taken(2000, [](std::size_t) {});
  EXPECT_EQ(numbers.size(), 2000U);
}

}  // namespace
}  // namespace talus
