#pragma once
/// Phases of a run.

#include <cstdint>

namespace talus::session {

/// Phases of a run. Flow: motion after failure, if the scenario follows it (tilt.after_failure), until rest.
enum class Phase : std::int64_t { deposition = 0, tilt = 1, done = 2, flow = 3 };

}  // namespace talus::session
