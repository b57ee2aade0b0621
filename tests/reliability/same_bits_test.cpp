/// The first thousands of steps of the rocked beds, compared with hashes that hold for every build and any
/// number of threads. tests/reliability/same_bits runs all steps, with other compilers and flags. A change
/// that alters bits must be listed in CHANGELOG.md and must update the hashes here.

#include <gtest/gtest.h>

#include "base/hash.h"
#include "reliability/rocked_bed.h"

namespace talus::test {
namespace {

/// Compares a bed of rocked_beds() after some steps on each number of threads. At least `changes` of the
/// steps must have changed contacts, and `team` is the largest number of threads that can work together.
void expect_bits(std::size_t which, std::int64_t steps, const std::string& golden, std::int64_t changes,
                 int team) {
  const RockedBed bed = rocked_beds().at(which);
  for (const int threads : {1, 2, 4}) {
    SCOPED_TRACE(bed.name + ", threads: " + std::to_string(threads));
    Hasher hash;
    const RockedRun run = rock(bed, steps, threads, [&hash](const World& world) {
      if (world.step % 10 == 0) hash.add(hash_of(world));
    });
    EXPECT_EQ(hash_text(hash.value()), golden);
    EXPECT_GT(run.changes, changes);
    EXPECT_EQ(run.team, std::min(threads, team));
  }
}

TEST(SameBits, periodic_bed) { expect_bits(0, 5000, "6ba1ab7f2538d394", 1000, 1); }
TEST(SameBits, walls_and_restitution) { expect_bits(1, 5000, "18d4afb3878f0328", 200, 1); }
TEST(SameBits, gauss_seidel) { expect_bits(2, 2000, "3a8b1ba81353dd03", 300, 1); }
TEST(SameBits, threads_that_work_together) { expect_bits(3, 60, "22dd5c797b068e7c", 40, 2); }

// While maps are drawn during a run, its solver has fewer threads.
TEST(SameBits, threads_that_come_and_go) {
  Hasher hash;
  const RockedRun run = rock(
      rocked_beds().at(3), 60, 2,
      [&hash](const World& world) {
        if (world.step % 10 == 0) hash.add(hash_of(world));
      },
      3);
  EXPECT_EQ(hash_text(hash.value()), "22dd5c797b068e7c") << "equal to a constant number of threads";
  EXPECT_EQ(run.team, 2);
}

}  // namespace
}  // namespace talus::test
