#pragma once
/// The phases of a run.

#include <cstdint>

namespace talus::session {

/// Flow: what follows failure where the scenario asks for it (tilt.after_failure), until the bed is at rest.
enum class Phase : std::int64_t { deposition = 0, tilt = 1, done = 2, flow = 3 };

}  // namespace talus::session
