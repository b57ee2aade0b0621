#pragma once
/// Beds that are tilted back and forth so that they fail and flow repeatedly. They are compared bit for bit
/// between threads, compilers and processors.

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
  std::int64_t steps = 0;  ///< number in a complete run
};

/// Returns three small beds (30 grains; 1e5 steps for the two that are solved like runs), and one in which
/// four threads have work (20 000 grains, 300 steps).
std::vector<RockedBed> rocked_beds();

/// Statistics of a run, which show that equal hashes are meaningful.
struct RockedRun {
  std::int64_t changes = 0;  ///< steps whose contacts differ from those of the previous step
  int team = 1;              ///< largest number of threads that worked together
};

/// Steps a bed on `threads` threads: it falls at tilt 0, then the tilt swings between 35 and -35 deg. Calls
/// watch(world) after each step. One step in `alone_every` runs on one thread; none if it is 0.
RockedRun rock(const RockedBed& bed, std::int64_t steps, int threads,
               const std::function<void(const World&)>& watch, int alone_every = 0);

/// Returns one hash of the state of a world and of quantities measured on it (internal moments, stress
/// ratios, free surface).
std::uint64_t hash_of(const World& world);

}  // namespace talus::test
