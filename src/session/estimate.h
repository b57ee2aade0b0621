#pragma once
/// Estimated cost of a run, from its scenario and, if it has one, the file of its bed.

#include <cstdint>
#include <string>

#include "core/types.h"
#include "scenario/scenario.h"

namespace talus::session {

using scenario::Scenario;

/// Assumed angle of failure for runs that end at repose, deg.
inline constexpr double assumed_repose = 20.0;

/// Returns the expected steps of the tilt: up to assumed_repose if it continues until the slope fails; with a
/// programme all steps, except those of its last part beyond that angle.
std::int64_t expected_tilt_steps(const Scenario& scenario);

/// Estimate of a run. Sizes and steps follow from the scenario, except for the length of the deposition and
/// the angle of repose; time, memory and disk space are within a factor of about two for beds like the
/// paper's.
struct Estimate {
  Index grains = 0;  ///< free grains
  Index floor_grains = 0;
  Index contacts = 0;                 ///< contacts in the problem of a step at rest
  double time_step = 0.0;             ///< h, s
  std::int64_t deposition_steps = 0;  ///< steps until the bed is at rest
  std::int64_t tilt_steps = 0;
  std::int64_t program_parts = 0;  ///< parts of a programme of the tilt, including repetitions; 0: none
  std::int64_t flow_steps = 0;     ///< maximum number of steps after failure
  std::int64_t frames = 0;         ///< maximum, including the flow; likewise the rows
  std::int64_t observable_rows = 0;
  double seconds = 0.0;  ///< wall time on one core
  double memory = 0.0;   ///< bytes, at most
  double disk = 0.0;     ///< bytes of the run file; 2.5 times that while it is packed
};

/// Returns the estimate of a run. Throws as grain_count does.
Estimate estimate(const Scenario& scenario);

/// Throws Error(out_of_memory) if a run needs more memory than this process can have, not counting the flow
/// after failure, which may be short.
void require_memory(const Scenario& scenario);

/// Returns "12 MB", "13.8 GB".
std::string size_text(double bytes);

/// Returns "8 s", "2 min 05 s", "3 h 10 min".
std::string duration_text(double seconds);

}  // namespace talus::session
