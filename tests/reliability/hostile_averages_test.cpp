/// ensemble.h5 as it may be at rest: HDF5 may fail on it, and values may have changed; no figure shows these.

#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <cstdio>

#include "core/random.h"
#include "ensemble/averages_file.h"
#include "ensemble/averages_reader.h"
#include "io/hdf5_handle.h"
#include "io/plain_file.h"
#include "reliability/hostile_test.h"
#include "scenario/scenario.h"

namespace talus::hostile {
namespace {

void make_good(const test::TemporaryFolder& folder) {
  std::vector<MemberResult> members;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    MemberResult member{seed, {"0123456789abcdef", "0.1.0", 1.0, {{"theta_c", "deg", 2.5}}}, {}};
    member.series = {{0.0, 1.0, 2.0}, {{"contacts/coordination_number", "1", {4.0, 3.5, 3.0}}}};
    members.push_back(member);
  }
  write_averages(folder.path("good.h5"), {{"", resolved_toml({}), averages_of(members, 1.0)}}, "0.1.0");
}

using HostileAverages = HostileFile<make_good>;

void use(const std::string& path) {
  for (const StoredVariant& variant : read_averages(path)) {
    const Scenario scenario = parse_scenario(variant.scenario, path);
    for (std::size_t m = 0; m < variant.seeds.size(); ++m)
      analysis_of(member_of(variant, m), scenario.grains.mean_diameter);
  }
}

TEST_F(HostileAverages, are_the_good_ones_to_begin_with) { EXPECT_EQ(refusal(bad(good), use), std::nullopt); }

TEST_F(HostileAverages, with_a_byte_flipped_anywhere_are_refused_or_have_the_same_values) {
  const std::vector<StoredVariant> before = read_averages(bad(good));
  Random random(70);
  int refused = 0, harmless = 0;
  for (int k = 0; k < tries(200); ++k) {
    Bytes bytes = good;
    const auto at = random.below(static_cast<std::uint32_t>(bytes.size()));
    bytes[at] ^= static_cast<std::byte>(1 + random.below(255));
    SCOPED_TRACE("byte " + std::to_string(at));
    if (refusal(bad(bytes), use)) {
      ++refused;
      continue;
    }
    ++harmless;
    for (const StoredVariant& variant : read_averages(bad(bytes))) {
      EXPECT_EQ(variant.seeds, before[0].seeds);
      for (const StoredQuantity& quantity : variant.over_tilt)
        EXPECT_EQ(quantity.values, before[0].over_tilt[0].values);
    }
  }
  std::printf("%d flips were refused, and %d harmless\n", refused, harmless);
  EXPECT_GT(refused, 0);
}

TEST_F(HostileAverages, cut_at_any_length_are_refused) {
  const std::size_t step = std::max<std::size_t>(1, good.size() / static_cast<std::size_t>(tries(100)));
  for (std::size_t size = 0; size < good.size(); size += step)
    EXPECT_TRUE(refusal(bad(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))), use))
        << size << " bytes";
}

// HDF5 would follow it, and a reader that skips it would miss a variant.
TEST_F(HostileAverages, with_a_link_are_refused) {
  for (const bool external : {false, true}) {
    const std::string path = bad(good);
    {
      const hdf5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
      ASSERT_GE(external ? H5Lcreate_external(folder->path("good.h5").c_str(), "/variants/0", file.get(),
                                              "/variants/1", H5P_DEFAULT, H5P_DEFAULT)
                         : H5Lcreate_soft("/variants/0", file.get(), "/variants/1", H5P_DEFAULT, H5P_DEFAULT),
                0);
    }
    const std::optional<std::string> said = refusal(path, use);
    ASSERT_TRUE(said) << external;
    EXPECT_NE(said->find("/variants/1 is a link to another place"), std::string::npos) << *said;
  }
}

TEST(PlainFile, cut_short_on_its_way_is_refused) {
  PlainFile file;
  file.texts = {{"/g", "name", {"a", ""}, true}};
  file.arrays = {{"/g/x", {1, 2}, "deg", "", {1.0, 2.0}, {}}, {"/g/k", {1}, "1", "", {}, {3}}};
  const std::vector<std::byte> bytes = encode(file);
  const PlainFile again = decode_plain(bytes, "p.h5");
  ASSERT_EQ(again.texts.size(), 1u);
  EXPECT_EQ(again.texts[0].texts, file.texts[0].texts);
  EXPECT_TRUE(again.texts[0].is_list);
  ASSERT_EQ(again.arrays.size(), 2u);
  EXPECT_EQ(again.arrays[0].shape, file.arrays[0].shape);
  EXPECT_EQ(again.arrays[0].values, file.arrays[0].values);
  EXPECT_EQ(again.arrays[0].unit, "deg");
  EXPECT_EQ(again.arrays[1].integers, file.arrays[1].integers);
  int whole = 0;
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    try {
      decode_plain(std::span(bytes).first(size), "p.h5");
      ++whole;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data);
    }
  }
  EXPECT_EQ(whole, 3) << "at the ends of arrays only";
}

}  // namespace
}  // namespace talus::hostile
