#pragma once
/// What the tests of bad files share: a good one, and bad ones made of it.

#include <gtest/gtest.h>

#include <cstdlib>
#include <exception>
#include <optional>
#include <string>

#include "base/errors.h"
#include "reliability/hostile_file.h"
#include "support/temporary_folder.h"

namespace talus::hostile {

/// How often a test of chance tries: TALUS_TRIES, where that is set, as in the long version.
inline int tries(int usual) {
  const char* asked = std::getenv("TALUS_TRIES");
  return asked != nullptr ? std::atoi(asked) : usual;
}

/// The error of using a file, if there is one; it must begin with the file, and be one of bad data, or of the
/// memory that HDF5 asked for in reading it.
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

/// Tests of a kind of file: `make` makes good.h5 in a folder, once for all of them.
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
