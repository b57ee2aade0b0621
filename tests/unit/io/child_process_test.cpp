/// Pieces of work that end their process take no others with them.

#include "io/child_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "core/descriptor.h"
#include "core/errors.h"
#include "core/sanitizers.h"

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

/// A lock on a run is held by whoever has its file open.
TEST(ChildProcesses, hold_no_file_of_their_parent) {
  const Descriptor file(::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 100));
  ASSERT_GE(file.get(), 100);
  const std::vector<std::byte> open = in_child_process("work", 0, [&] {
    return std::vector<std::byte>{::fcntl(file.get(), F_GETFD) < 0 ? std::byte{0} : std::byte{1}};
  });
  EXPECT_EQ(open, std::vector{std::byte{0}});
}

TEST(ChildProcesses, do_much_in_one) {
  const std::vector<std::size_t> numbers = taken(2000, [](std::size_t) {});
  EXPECT_EQ(numbers.size(), 2000U);
}

/// What a child does, and how that ends.
std::string end_of(const std::function<std::vector<std::byte>()>& work) {
  try {
    const auto bytes = in_child_process("p.h5", 0, work);
    return "returned " + std::to_string(bytes.size());
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::bad_data);
    return error.what();
  }
}

TEST(ChildProcess, gives_back_bytes_errors_and_its_death) {
  EXPECT_EQ(end_of([] { return std::vector<std::byte>(3 << 20); }), "returned " + std::to_string(3 << 20));
  EXPECT_EQ(end_of([] { return std::vector<std::byte>(); }), "returned 0");
  EXPECT_EQ(end_of([]() -> std::vector<std::byte> { throw Error(ExitCode::bad_data, "said so"); }),
            "said so");
  const std::string died = "p.h5: cannot be read: HDF5 fails on it";
  EXPECT_EQ(end_of([]() -> std::vector<std::byte> { std::abort(); }).find(died), 0u);
  EXPECT_EQ(end_of([]() -> std::vector<std::byte> { std::exit(0); }).find(died), 0u);
  EXPECT_EQ(end_of([]() -> std::vector<std::byte> { throw 1; }).find(died), 0u);
}

TEST(ChildProcess, has_only_so_much_memory) {
  if (sanitizes_addresses) GTEST_SKIP() << "memory is not limited";
  std::size_t most = std::size_t{4} << 30;
  EXPECT_NE(end_of([&] { return std::vector<std::byte>(most); }).find("more memory"), std::string::npos);
}

}  // namespace
}  // namespace talus
