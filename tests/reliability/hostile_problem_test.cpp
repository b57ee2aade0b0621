/// Problem files of other programs, which no hash protects: HDF5 may fail on them, but this process must not.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "base/errors.h"
#include "core/random.h"
#include "problems/fclib_file.h"
#include "reliability/hostile_run.h"
#include "reliability/hostile_test.h"

namespace talus::hostile {
namespace {

void make_good(const test::TemporaryFolder& folder) {
  make_run(folder.path("run.h5"));
  make_problem(folder.path("run.h5"), folder.path("good.h5"));
}

using HostileProblem = HostileFile<make_good>;

std::optional<std::string> refusal(const std::string& path) { return hostile::refusal(path, use_problem); }

TEST_F(HostileProblem, is_the_good_one_to_begin_with) {
  EXPECT_EQ(refusal(bad(good)), std::nullopt);
  EXPECT_EQ(refusal(bad(spoilt(good, {}))), std::nullopt);
}

TEST_F(HostileProblem, a_byte_flipped_anywhere_is_refused_or_harmless) {
  Random random(40);
  const int count = tries(200);
  int refused = 0, failed = 0;
  for (int k = 0; k < count; ++k) {
    Bytes bytes = good;
    const auto at = random.below(static_cast<std::uint32_t>(bytes.size()));
    bytes[at] ^= static_cast<std::byte>(1 + random.below(255));
    SCOPED_TRACE("byte " + std::to_string(at));
    const auto message = refusal(bad(bytes));
    refused += message ? 1 : 0;
    failed += message && message->find("HDF5") != std::string::npos ? 1 : 0;
  }
  RecordProperty("refused", refused);
  RecordProperty("failed_in_the_child", failed);
  std::printf("%d flips: %d refused, of these %d where HDF5 itself failed\n", count, refused, failed);
  EXPECT_GT(refused, 0);
}

TEST_F(HostileProblem, cut_at_any_length_is_refused) {
  const std::size_t step = std::max<std::size_t>(1, good.size() / static_cast<std::size_t>(tries(200)));
  for (std::size_t size = 0; size < good.size(); size += step)
    EXPECT_TRUE(refusal(bad(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)))))
        << size << " bytes";
}

TEST_F(HostileProblem, each_data_set_of_another_make_is_refused_by_name) {
  for (const std::string& path : data_sets(good)) {
    if (path.starts_with("/fclib_local/info/")) continue;
    for (const Harm harm : {Harm::missing, Harm::group_instead, Harm::as_text, Harm::as_compound, Harm::huge,
                            Harm::values_in_another_file, Harm::external_link}) {
      const bool unread = path == "/guesses/1/u" || path.ends_with("/nzmax") || path.ends_with("_guesses");
      const bool needless = path.starts_with("/guesses/");
      if (harm == Harm::missing && (unread || needless)) continue;
      const auto message =
          refusal(bad(spoilt(good, std::vector<Spoil>{{path, harm, 0, 0, folder->path("good.h5")}})));
      ASSERT_TRUE(message) << path << " " << name_of(harm) << " was accepted";
      EXPECT_NE(message->find(path), std::string::npos) << name_of(harm) << ": " << *message;
    }
  }
}

TEST_F(HostileProblem, values_of_chance_are_refused_or_harmless) {
  const std::vector<std::string> paths = data_sets(good);
  Random random(50);
  for (int k = 0; k < tries(200); ++k) {
    std::vector<Spoil> spoils(1 + random.below(2));
    for (Spoil& spoil : spoils)
      spoil = {paths[random.below(static_cast<std::uint32_t>(paths.size()))],
               static_cast<Harm>(random.below(harm_count)), random.next(), random.below(40),
               folder->path("good.h5")};
    SCOPED_TRACE(spoils.front().path + " " + name_of(spoils.front().harm));
    refusal(bad(spoilt(good, spoils)));
  }
}

TEST_F(HostileProblem, a_solution_is_added_to_a_flipped_file_or_not) {
  Random random(60);
  for (int k = 0; k < tries(300) / 3; ++k) {
    Bytes bytes = good;
    bytes[random.below(static_cast<std::uint32_t>(bytes.size()))] ^= std::byte{0x41};
    const std::string path = bad(bytes), to = folder->path("solved.h5");
    try {
      problems::write_fclib_solution(path, to, {1.0, 2.0}, {3.0, 4.0});
      EXPECT_TRUE(std::filesystem::exists(to));
    } catch (const Error&) {
      EXPECT_FALSE(std::filesystem::exists(to));
    }
    std::filesystem::remove(to);
  }
}

}  // namespace
}  // namespace talus::hostile
