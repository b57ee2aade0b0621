#pragma once
/// Common parts of the tests of bad files: a good file, and bad ones made from it.

#include <gtest/gtest.h>

#include <cstdlib>
#include <exception>
#include <optional>
#include <string>

#include "base/errors.h"
#include "reliability/hostile_file.h"
#include "support/temporary_folder.h"

namespace talus::hostile {

/// Returns the number of tries of a random test: TALUS_TRIES if it is set, as in the long version.
inline int tries(int usual) {
  const char* asked = std::getenv("TALUS_TRIES");
  return asked != nullptr ? std::atoi(asked) : usual;
}

/// Returns the error of using a file, if any. Its message must begin with the file; the error must be about
/// bad data, or about memory that HDF5 requested while reading.
inline std::optional<std::string> refusal(const std::string& path, void (*use)(const std::string&)) {
  try {
    use(path);
  } catch (const Error& error) {
    EXPECT_TRUE(error.code() == ExitCode::bad_data || error.code() == ExitCode::out_of_memory)
        << error.what();
    EXPECT_EQ(std::string(error.what()).find(path), 0U) << error.what();
    return error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << error.what();
    return error.what();
  }
  return std::nullopt;
}

/// Tests of a kind of file: `make` creates good.h5 in a folder shared by all of them.
template <void (*make)(const test::TemporaryFolder&)>
class HostileFile : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new test::TemporaryFolder;
    make(*folder);
    good = read_bytes(folder->path("good.h5"));
  }
  static void TearDownTestSuite() {
    delete folder;
    folder = nullptr;
  }
  static std::string bad(const Bytes& bytes) {
    const std::string path = folder->path("bad.h5");
    write_bytes(path, bytes);
    return path;
  }

  static inline test::TemporaryFolder* folder = nullptr;
  static inline Bytes good;
};

}  // namespace talus::hostile
