/// Damaged files ensemble.h5, and intact ones with impossible values: rejected with the place, or harmless.

#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <filesystem>

#include "core/random.h"
#include "ensemble/averages_file.h"
#include "ensemble/averages_reader.h"
#include "io/child_process.h"
#include "io/hdf5_handle.h"
#include "io/seal.h"
#include "reliability/hostile_test.h"
#include "scenario/scenario.h"

namespace talus::hostile {
namespace {

void make_good(const test::TemporaryFolder& folder) {
  std::vector<ensemble::MemberResult> members;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    ensemble::MemberResult member{seed, {"0123456789abcdef", "0.1.0", 1.0, {{"theta_c", "deg", 2.5}}}, {}};
    member.series = {{0.0, 1.0, 2.0}, {{"contacts/coordination_number", "1", {4.0, 3.5, 3.0}}}};
    members.push_back(member);
  }
  ensemble::write_averages(folder.path("good.h5"),
                           {{"", scenario::resolved_toml({}), ensemble::averages_of(members, 1.0)}}, "0.1.0");
}

using HostileAverages = HostileFile<make_good>;

void use(const std::string& path) {
  for (const ensemble::StoredVariant& variant : ensemble::read_averages(path)) {
    const scenario::Scenario scenario = scenario::parse_scenario(variant.scenario, path);
    for (std::size_t m = 0; m < variant.seeds.size(); ++m)
      ensemble::analysis_of(ensemble::member_of(variant, m), scenario.grains.mean_diameter);
  }
}

/// Uses the file in a child process, because HDF5 may crash on malformed files that were sealed again.
void use_apart(const std::string& path) {
  io::in_child_process(path, std::filesystem::file_size(path), [&path] {
    use(path);
    return io::Parcels();
  });
}

TEST_F(HostileAverages, are_the_good_ones_to_begin_with) {
  EXPECT_EQ(refusal(bad(good), use), std::nullopt);
  EXPECT_EQ(refusal(bad(spoilt(good, {})), use), std::nullopt);
}

TEST_F(HostileAverages, with_a_byte_flipped_anywhere_are_refused) {
  Random random(70);
  for (int k = 0; k < tries(200); ++k) {
    Bytes bytes = good;
    const auto at = random.below(static_cast<std::uint32_t>(bytes.size()));
    bytes[at] ^= static_cast<std::byte>(1 + random.below(255));
    EXPECT_TRUE(refusal(bad(bytes), use)) << "byte " << at;
  }
}

TEST_F(HostileAverages, with_a_byte_flipped_and_sealed_again_are_refused_or_harmless) {
  Random random(71);
  for (int k = 0; k < tries(100); ++k) {
    Bytes bytes = good;
    const auto at = io::seal_size + random.below(static_cast<std::uint32_t>(bytes.size() - io::seal_size));
    bytes[at] ^= static_cast<std::byte>(1 + random.below(255));
    SCOPED_TRACE("byte " + std::to_string(at));
    refusal(bad(sealed(bytes, io::averages_seal)), use_apart);
  }
}

TEST_F(HostileAverages, with_harm_of_chance_are_refused_or_harmless) {
  const std::vector<std::string> paths = data_sets(good);
  Random random(72);
  int refused = 0;
  for (int k = 0; k < tries(200); ++k) {
    const std::vector<Spoil> spoils = spoils_of_chance(random, paths, folder->path("good.h5"));
    SCOPED_TRACE(spoils.front().path + " " + name_of(spoils.front().harm));
    refused += refusal(bad(spoilt(good, spoils)), use_apart) ? 1 : 0;
  }
  EXPECT_GT(refused, 0);
}

TEST_F(HostileAverages, cut_at_any_length_are_refused) {
  const std::size_t step = std::max<std::size_t>(1, good.size() / static_cast<std::size_t>(tries(100)));
  for (std::size_t size = 0; size < good.size(); size += step)
    EXPECT_TRUE(refusal(bad(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size))), use))
        << size << " bytes";
}

TEST_F(HostileAverages, of_an_earlier_version_are_refused) {
  const Bytes bytes(good.begin() + static_cast<std::ptrdiff_t>(io::seal_size), good.end());
  const std::optional<std::string> said = refusal(bad(bytes), use);
  ASSERT_TRUE(said);
  EXPECT_NE(said->find("recreate it with: talus ensemble average"), std::string::npos) << *said;
}

// HDF5 would follow the link, and a reader that skips it would miss a variant.
TEST_F(HostileAverages, with_a_link_are_refused) {
  for (const bool external : {false, true}) {
    const std::string path = bad(good);
    {
      const io::hdf5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose);
      ASSERT_GE(external ? H5Lcreate_external(folder->path("good.h5").c_str(), "/variants/0", file.get(),
                                              "/variants/1", H5P_DEFAULT, H5P_DEFAULT)
                         : H5Lcreate_soft("/variants/0", file.get(), "/variants/1", H5P_DEFAULT, H5P_DEFAULT),
                0);
    }
    const std::optional<std::string> said = refusal(bad(sealed(read_bytes(path), io::averages_seal)), use);
    ASSERT_TRUE(said) << external;
    EXPECT_NE(said->find("/variants/1 is a link to another place"), std::string::npos) << *said;
  }
}

}  // namespace
}  // namespace talus::hostile
