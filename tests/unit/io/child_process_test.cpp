/// Work that ends its process does not end the parent.

#include "io/child_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "base/descriptor.h"
#include "base/errors.h"
#include "base/sanitizers.h"

namespace talus::io {
namespace {

/// A lock on a run is held by every process that has its file open.
TEST(ChildProcess, holds_no_file_of_its_parent) {
  const Descriptor file(::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 100));
  ASSERT_GE(file.get(), 100);
  const Parcels open = in_child_process("work", 0, [&] {
    return Parcels{{"open", {::fcntl(file.get(), F_GETFD) < 0 ? std::byte{0} : std::byte{1}}}};
  });
  EXPECT_EQ(open.at("open"), std::vector{std::byte{0}});
}

/// Returns how a child that does this ends.
std::string end_of(const std::function<std::vector<std::byte>()>& work) {
  try {
    Parcels found = in_child_process("p.h5", 0, [&] { return Parcels{{"bytes", work()}}; });
    return "returned " + std::to_string(found["bytes"].size());
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

TEST(Parcels, cut_short_on_their_way_are_refused) {
  const std::vector<double> reals = {1.0, 2.0};
  const Parcels parcels = {{"/g", {}}, {"/g/x", bytes_of(reals)}, {"/g/k", bytes_of(std::vector<int>{3})}};
  const std::vector<std::byte> bytes = encode(parcels);
  EXPECT_EQ(decode(bytes, "p.h5"), parcels);
  EXPECT_EQ(values_of<std::vector<double>>(parcels.at("/g/x")), reals);
  int whole = 0;
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    try {
      decode(std::span(bytes).first(size), "p.h5");
      ++whole;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
    }
  }
  EXPECT_EQ(whole, 4) << "only at the ends of parcels";
}

}  // namespace
}  // namespace talus::io
