#pragma once
/// What a run will take, from its scenario, and from the file of its bed if it has one.

#include <cstdint>
#include <string>

#include "core/types.h"
#include "scenario/scenario.h"

namespace talus::session {

/// The angle at which a slope is assumed to fail where the run ends at repose, deg.
inline constexpr double assumed_repose = 20.0;

/// Steps that the tilt will take: where it goes on until the slope fails, to assumed_repose; with a programme
/// all of it, but for what its last part does beyond that angle.
std::int64_t expected_tilt_steps(const scenario::Scenario& scenario);

/// Sizes and steps follow from the scenario, but for the length of the deposition and the angle of repose;
/// time, memory and disk are within a factor of about two for beds like the paper's.
struct Estimate {
  Index grains = 0;  ///< free
  Index floor_grains = 0;
  Index contacts = 0;                 ///< in the problem of a step at rest
  double time_step = 0.0;             ///< h, s
  std::int64_t deposition_steps = 0;  ///< until the bed is at rest
  std::int64_t tilt_steps = 0;
  std::int64_t program_parts = 0;  ///< of a programme of the tilt, repetitions included; 0: none
  std::int64_t flow_steps = 0;     ///< after failure, at most
  std::int64_t frames = 0;         ///< with those of the flow, at most, as the rows
  std::int64_t observable_rows = 0;
  double seconds = 0.0;  ///< wall time on one core
  double memory = 0.0;   ///< bytes, at most
  double disk = 0.0;     ///< bytes of the run file; 2.5 times that while it is packed
};

/// Throws as grain_count does.
Estimate estimate(const scenario::Scenario& scenario);

/// Throws Error(out_of_memory) where a run takes more memory than this process can have, without the flow
/// after failure, which may be short.
void require_memory(const scenario::Scenario& scenario);

/// "12 MB", "13.8 GB".
std::string size_text(double bytes);

/// "8 s", "2 min 05 s", "3 h 10 min".
std::string duration_text(double seconds);

}  // namespace talus::session
