/// Damaged files ensemble.h5, and intact ones with impossible values: rejected with the place, or harmless.

#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>

#include "core/random.h"
#include "ensemble/averages.h"
#include "io/child_process.h"
#include "io/durable_file.h"
#include "io/hdf5_file.h"
#include "reliability/hostile_test.h"
#include "scenario/scenario.h"

namespace talus::hostile {
namespace {

void make_good(const test::CommandFolder& folder) {
  std::vector<ensemble::MemberResult> members;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    ensemble::MemberResult member{seed, {"0123456789abcdef", "0.1.0", 1.0, {{"theta_c", 2.5}}}, {}, 0.01};
    member.analysis.thresholds = {{.factor = 1.0, .gamma = 0.3}};
    for (int k = 0; k < 3; ++k)
      member.analysis.frames.push_back({.tilt = 0.02 * k,
                                        .coordination_number = 4.0 - k,
                                        .thresholds = {{.overloaded_fraction = 0.1 * k}}});
    members.push_back(member);
  }
  std::vector<const ensemble::MemberResult*> pointers;
  for (const ensemble::MemberResult& member : members) pointers.push_back(&member);
  ensemble::write_averages(folder.path("good.h5"),
                           {ensemble::averages_of("", scenario::resolved_toml({}), pointers, 1.0)}, "0.1.0");
}

using HostileAverages = HostileFile<make_good>;

void use(const std::string& path) { ensemble::read_averages(path); }

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
  expect_flips_refused(use, 70, tries(200));
}

TEST_F(HostileAverages, with_a_byte_flipped_and_sealed_again_are_refused_or_harmless) {
  Random random(71);
  for (int k = 0; k < tries(100); ++k) {
    Bytes bytes = good;
    const std::size_t at = flip(bytes, random, io::seal_size);
    SCOPED_TRACE("byte " + std::to_string(at));
    refusal(bad(io::sealed(bytes, io::averages_seal)), use_apart);
  }
}

TEST_F(HostileAverages, with_harm_of_chance_are_refused_or_harmless) {
  EXPECT_GT(refusals_of_chance(use_apart, data_sets(good), 72, tries(200)), 0);
}

TEST_F(HostileAverages, cut_at_any_length_are_refused) { expect_cuts_refused(use, tries(100)); }

TEST_F(HostileAverages, of_an_earlier_version_are_refused) {
  const Bytes bytes(good.begin() + static_cast<std::ptrdiff_t>(io::seal_size), good.end());
  const std::optional<std::string> said = refusal(bad(bytes), use);
  ASSERT_TRUE(said);
  EXPECT_TRUE(has(*said, "recreate it with: talus ensemble average"));
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
    const std::optional<std::string> said =
        refusal(bad(io::sealed(read_bytes(path), io::averages_seal)), use);
    ASSERT_TRUE(said) << external;
    EXPECT_TRUE(has(*said, "/variants/1/seed is a link to another place"));
  }
}

}  // namespace
}  // namespace talus::hostile
