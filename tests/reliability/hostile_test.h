#pragma once
/// Common parts of the tests of bad files: a good file, and bad ones made from it.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <optional>
#include <string>

#include "base/errors.h"
#include "core/random.h"
#include "reliability/hostile_file.h"
#include "support/commands.h"

namespace talus::hostile {

using test::has;
using test::Outcome;
using test::Words;

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

enum class Damage : std::uint8_t { flip, zeros, cut };
inline constexpr std::array damages = {Damage::flip, Damage::zeros, Damage::cut};

/// Flips a byte from `from` on; returns its place.
inline std::size_t flip(Bytes& bytes, Random& random, std::size_t from = 0) {
  const std::size_t at = from + random.below(static_cast<std::uint32_t>(bytes.size() - from));
  bytes[at] ^= static_cast<std::byte>(1 + random.below(255));
  return at;
}

/// Flips a byte, writes up to 4 KiB of zeros, or truncates.
inline void damage(Bytes& bytes, Damage kind, Random& random) {
  if (kind == Damage::flip) {
    flip(bytes, random);
    return;
  }
  const std::size_t at = random.below(static_cast<std::uint32_t>(bytes.size()));
  if (kind == Damage::cut) return bytes.resize(at);
  const std::size_t count = std::min<std::size_t>(bytes.size() - at, std::size_t{1} << random.below(13));
  std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), count, std::byte{0});
}

/// Tests of a kind of file: `make` creates good.h5 in a folder shared by all of them.
template <void (*make)(const test::CommandFolder&)>
class HostileFile : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new test::CommandFolder;
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

  /// Expects the good file with any byte flipped to be refused.
  static void expect_flips_refused(void (*use)(const std::string&), std::uint64_t seed, int count) {
    Random random(seed);
    for (int k = 0; k < count; ++k) {
      Bytes bytes = good;
      const std::size_t at = flip(bytes, random);
      EXPECT_TRUE(refusal(bad(bytes), use)) << "byte " << at;
    }
  }

  /// Expects the good file cut at `count` lengths, and at any up to 600 bytes, to be refused.
  static void expect_cuts_refused(void (*use)(const std::string&), int count) {
    const std::size_t step = std::max<std::size_t>(1, good.size() / static_cast<std::size_t>(count));
    for (std::size_t size = 0; size < good.size(); size += size < 600 ? std::min<std::size_t>(7, step) : step)
      EXPECT_TRUE(refusal(bad(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))), use))
          << size << " bytes";
  }

  /// Damages data sets of these paths at random; returns how many of the files are refused. The others must
  /// be harmless.
  static int refusals_of_chance(void (*use)(const std::string&), const Words& paths, std::uint64_t seed,
                                int count) {
    Random random(seed);
    int refused = 0;
    for (int k = 0; k < count; ++k) {
      const std::vector<Spoil> spoils = spoils_of_chance(random, paths, folder->path("good.h5"));
      SCOPED_TRACE(spoils.front().path + " " + name_of(spoils.front().harm) + " " +
                   std::to_string(spoils.front().bits));
      refused += refusal(bad(spoilt(good, spoils)), use) ? 1 : 0;
    }
    return refused;
  }

  static inline test::CommandFolder* folder = nullptr;
  static inline Bytes good;
};

}  // namespace talus::hostile
