/// Damaged run files, and intact ones with impossible values: rejected with the place, or harmless.

#include "reliability/hostile_run.h"

#include <gtest/gtest.h>

#include <optional>

#include "core/random.h"
#include "io/child_process.h"
#include "io/run_file.h"
#include "reliability/hostile_test.h"
#include "support/has.h"

namespace talus::hostile {
namespace {

namespace fs = std::filesystem;

void open_run(const std::string& path) { io::RunFile::open(path); }

/// Uses the file in a child process, because HDF5 may crash on malformed files that were sealed again. Taking
/// longer than any file needs is also a failure.
void use_apart(const std::string& path) {
  io::in_child_process(path, fs::file_size(path), [&path] {
    use_run(path);
    return io::Parcels();
  });
}

std::optional<std::string> refusal(const std::string& path, void (*use)(const std::string&) = use_apart) {
  return hostile::refusal(path, use);
}

void make_good(const test::CommandFolder& folder) { make_run(folder.path("good.h5")); }

using HostileRun = HostileFile<make_good>;

TEST_F(HostileRun, is_the_good_one_to_begin_with) {
  EXPECT_EQ(refusal(bad(good)), std::nullopt);
  EXPECT_EQ(refusal(bad(spoilt(good, {}))), std::nullopt);
}

/// Returns whether a data set is read; others may have any content.
bool is_read(const std::string& path) {
  for (const char* unread : {"/help/", "/h5md/", "/particles/grains/id", "/contents", "/frames/hash"})
    if (path.starts_with(unread)) return false;
  return !((path.starts_with("/particles/") && (path.ends_with("/step") || path.ends_with("/time"))));
}

/// Returns whether a name is optional: without it the run is different but valid.
bool may_be_missing(const std::string& path) {
  for (const char* family :
       {"/provenance/", "/results/", "/analysis/parameters/", "/checkpoint/reals/friction",
        "/checkpoint/reals/deposition_friction", "/checkpoint/reals/last_"})
    if (path.starts_with(family)) return true;
  return false;
}

TEST_F(HostileRun, each_data_set_of_another_make_is_refused_by_name) {
  const std::vector<Harm> harms = {
      Harm::missing,       Harm::as_text_of_variable_length, Harm::group_instead, Harm::as_compound,
      Harm::one_rank_more, Harm::values_in_another_file,     Harm::external_link};
  const std::size_t of_each = tries(2) > 2 ? harms.size() : 2;
  std::size_t next = 0, refused = 0;
  for (const std::string& path : data_sets(good)) {
    if (!is_read(path)) continue;
    for (std::size_t k = 0; k < of_each; ++k) {
      const Harm harm = harms[next++ % harms.size()];
      if ((harm == Harm::missing || harm == Harm::group_instead) && may_be_missing(path)) continue;
      const auto message =
          refusal(bad(spoilt(good, std::vector<Spoil>{{path, harm, 0, 0, folder->path("good.h5")}})));
      ASSERT_TRUE(message) << path << " " << name_of(harm) << " was accepted";
      const auto leaf = path.rfind('/');
      EXPECT_TRUE(test::has(*message, path.substr(0, leaf)) || test::has(*message, path.substr(leaf + 1)))
          << path << ": " << *message;
      ++refused;
    }
  }
  EXPECT_GT(refused, 200U);
}

/// Values by their numbers in hostile_file.cpp.
constexpr std::uint64_t nan = 0, infinite = 1, zero = 3, minus_one = 4, far_away = 5,
                        far_away_still_float = 7;                // for floats
constexpr std::uint64_t negative = 0, largest = 1, of_int8 = 6;  // for integers

TEST_F(HostileRun, values_that_cannot_be_are_refused_by_name) {
  const std::vector<std::pair<const char*, std::uint64_t>> cases = {
      {"/parameters/schema_version", negative},
      {"/parameters/mean_diameter", zero},
      {"/parameters/mean_diameter", nan},
      {"/parameters/gravity", infinite},
      {"/parameters/friction", minus_one},
      {"/particles/grains/box/edges", zero},
      {"/particles/grains/radius", minus_one},
      {"/particles/grains/radius", nan},
      {"/particles/grains/mass", infinite},
      {"/particles/grains/species", of_int8},
      {"/frames/tilt", nan},
      {"/frames/time", infinite},
      {"/particles/grains/position/value", nan},
      {"/particles/grains/position/value", far_away_still_float},
      {"/particles/grains/velocity/value", infinite},
      {"/particles/grains/angle/value", nan},
      {"/particles/grains/angular_velocity/value", nan},
      {"/particles/grains/internal_moment/value", nan},
      {"/contacts/offset", negative},
      {"/contacts/offset", largest},
      {"/contacts/pair", negative},
      {"/contacts/pair", 3},
      {"/contacts/shift", of_int8},
      {"/contacts/status", of_int8},
      {"/contacts/normal", nan},
      {"/contacts/point", nan},
      {"/contacts/point", far_away_still_float},
      {"/contacts/force", infinite},
      {"/observables/tilt", nan},
      {"/observables/step", nan},
      {"/steps/phase", infinite},
      {"/commands/kind", of_int8},
      {"/commands/step", negative},
      {"/commands/x", nan},
      {"/checkpoint/step", negative},
      {"/checkpoint/tilt", nan},
      {"/checkpoint/gravity", minus_one},
      {"/checkpoint/free_count", largest},
      {"/checkpoint/x", nan},
      {"/checkpoint/y", far_away},
      {"/checkpoint/radius", minus_one},
      {"/checkpoint/length", zero},
      {"/checkpoint/plane_normal", far_away},
      {"/checkpoint/plane_offset", nan},
      {"/checkpoint/contact_pair", negative},
      {"/checkpoint/contact_normal", nan},
      {"/checkpoint/contact_gap", infinite},
      {"/checkpoint/contact_force", nan},
  };
  for (const auto& [path, bits] : cases) {
    const auto message = refusal(bad(spoilt(good, std::vector<Spoil>{{path, Harm::one_value, 1, bits, {}}})));
    ASSERT_TRUE(message) << path << " with value " << bits << " was accepted";
    EXPECT_TRUE(has(*message, std::string("data set ") + path));
  }
  const auto changed =
      refusal(bad(spoilt(good, std::vector<Spoil>{{"/checkpoint/x", Harm::one_value, 1, 10, {}}})));
  EXPECT_TRUE(test::has(changed.value_or(""), "data set /checkpoint/state_hash is "));
  for (const char* count : {"/checkpoint/integers/tilt_steps", "/checkpoint/integers/phase"}) {
    const auto message =
        refusal(bad(spoilt(good, std::vector<Spoil>{{count, Harm::one_value, 0, negative, {}}})));
    EXPECT_TRUE(test::has(message.value_or(""), std::string("data set ") + count + " is -1")) << count;
  }
}

TEST_F(HostileRun, sizes_and_values_of_chance_are_refused_or_harmless) {
  const int count = tries(200);
  EXPECT_GT(refusals_of_chance(use_apart, data_sets(good), 20, count), count / 4);
}

TEST_F(HostileRun, a_byte_flipped_anywhere_is_refused) { expect_flips_refused(open_run, 10, tries(400)); }

TEST_F(HostileRun, a_byte_flipped_and_sealed_again_is_refused_or_harmless) {
  Random random(11);
  int refused = 0;
  const int count = tries(40);
  for (int k = 0; k < count; ++k) {
    Bytes bytes = good;
    SCOPED_TRACE(flip(bytes, random));
    const std::optional<std::string> message = refusal(bad(io::sealed(bytes)));
    EXPECT_FALSE(test::has(message.value_or(""), "longer than a file of its size can need"));
    refused += message ? 1 : 0;
  }
  EXPECT_GT(refused, count / 20);
}

TEST_F(HostileRun, cut_at_any_length_is_refused) { expect_cuts_refused(open_run, tries(400)); }

TEST_F(HostileRun, a_byte_flipped_or_a_cut_in_a_folder_is_refused) {
  const std::string run = folder->path("stopped.h5");
  make_folder_of_run(run);
  Random random(30);
  for (const auto& entry : fs::directory_iterator(io::run_folder(run))) {
    if (entry.path().filename() == "lock") continue;
    const Bytes whole = read_bytes(entry.path());
    for (int k = 0; k < tries(400) / 4; ++k) {
      Bytes bytes = whole;
      damage(bytes, k % 2 == 0 ? Damage::cut : Damage::flip, random);
      write_bytes(entry.path(), bytes);
      EXPECT_TRUE(refusal(run, open_run)) << entry.path() << ", try " << k;
    }
    write_bytes(entry.path(), whole);
  }
  EXPECT_EQ(refusal(run, open_run), std::nullopt);
}

}  // namespace
}  // namespace talus::hostile
