#pragma once
/// From a scenario to the bed before its first step, and what arrives in it afterwards.

#include <string>
#include <vector>

#include "dynamics/pour.h"
#include "scenario/scenario.h"

namespace talus::session {

/// The bed before its first step: all grains, or where they are poured none, above or on the floor. Throws as
/// bed_of_file does where they are those of a file, and `remark` becomes what that says.
World initial_bed(const scenario::Scenario& scenario, std::string* remark = nullptr);

/// The hash of the bed that a scenario takes from a file, before its first step; empty for other methods.
/// Throws as bed_of_file does.
std::string bed_hash(const scenario::Scenario& scenario);

/// Its walls and its smooth floor, which stay as they are.
Boundary boundary_of(const scenario::Scenario& scenario);

/// How many grains the bed will have. Reads and checks a file, and throws as bed_of_file does.
Index grain_count(const scenario::Scenario& scenario);

/// The grains that are poured, in the order of their arrival; none for other methods.
std::vector<dynamics::Arrival> arrivals_of(const scenario::Scenario& scenario);

/// How they arrive, in SI units.
dynamics::PourRule pour_rule(const scenario::Scenario& scenario);

/// When the last grain arrives, s; 0 where all are there from the beginning.
double end_of_arrivals(const scenario::Scenario& scenario);

/// What to do about a bed that did not come to rest in time, with the key that keeps it from it; `velocity`
/// in g h.
std::string advice_for_rest(const scenario::Scenario& scenario, double velocity);

}  // namespace talus::session
