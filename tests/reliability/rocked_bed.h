#pragma once
/// Beds that are tilted to and fro, so that they fail and flow again and again: what is compared, bit for
/// bit, between threads, compilers and processors.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "dynamics/bed.h"
#include "dynamics/step.h"

namespace talus::test {

struct RockedBed {
  std::string name;
  dynamics::BedPlan plan;
  solver::SolverKind solver = solver::SolverKind::accelerated;
  double restitution = 0.0;
  std::int64_t steps = 0;  ///< of a whole run
};

/// Three small beds (30 grains; the two that are solved as runs are take 1e5 steps), and one in which four
/// threads have work (20 000 grains, 300 steps).
std::vector<RockedBed> rocked_beds();

/// What a run has gone through, so that equal hashes mean something.
struct RockedRun {
  std::int64_t changes = 0;  ///< steps that had other contacts than the step before
  int team = 1;              ///< most threads that worked together
};

/// Steps a bed on so many threads: it falls at tilt 0, then the tilt swings between 35 and -35 deg. Calls
/// watch(world) after each step. One step of `alone_every` is on one thread, none where it is 0.
RockedRun rock(const RockedBed& bed, std::int64_t steps, int threads,
               const std::function<void(const World&)>& watch, int alone_every = 0);

/// The state of a world, and what is measured on it (internal moments, stress ratios, free surface), as one
/// hash.
std::uint64_t hash_of(const World& world);

}  // namespace talus::test
