/// Problem files of other programs, which no hash protects: HDF5 may fail on them, but this process must not.

#include <gtest/gtest.h>

#include <cstdio>
#include <optional>

#include "base/errors.h"
#include "core/random.h"
#include "problems/fclib_file.h"
#include "reliability/hostile_run.h"
#include "reliability/hostile_test.h"

namespace talus::hostile {
namespace {

void make_good(const test::CommandFolder& folder) {
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
    const std::size_t at = flip(bytes, random);
    SCOPED_TRACE("byte " + std::to_string(at));
    const auto message = refusal(bad(bytes));
    refused += message ? 1 : 0;
    failed += message && message->find("HDF5") != std::string::npos ? 1 : 0;
  }
  std::printf("%d flips: %d refused, of these %d where HDF5 itself failed\n", count, refused, failed);
  EXPECT_GT(refused, 0);
}

TEST_F(HostileProblem, cut_at_any_length_is_refused) { expect_cuts_refused(use_problem, tries(200)); }

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
  refusals_of_chance(use_problem, data_sets(good), 50, tries(200));
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
