#pragma once
/// Initial bed of a scenario, and the grains that arrive later.

#include <string>
#include <vector>

#include "dynamics/pour.h"
#include "scenario/scenario.h"

namespace talus::session {

/// Returns the bed before its first step: all grains, or none if they are poured, above or on the floor.
/// Grains from a file: throws as bed_of_file does, and `remark` receives its remark.
World initial_bed(const scenario::Scenario& scenario, std::string* remark = nullptr);

/// Returns the hash of the initial bed that a scenario takes from a file; empty for other methods. Throws as
/// bed_of_file does.
std::string bed_hash(const scenario::Scenario& scenario);

/// Returns walls and smooth floor of the bed, which do not change.
Boundary boundary_of(const scenario::Scenario& scenario);

/// Returns the final number of grains in the bed. Reads and checks a file, and throws as bed_of_file does.
Index grain_count(const scenario::Scenario& scenario);

/// Returns the poured grains in the order of their arrival; none for other methods.
std::vector<dynamics::Arrival> arrivals_of(const scenario::Scenario& scenario);

/// Returns the rule of their arrival, in SI units.
dynamics::PourRule pour_rule(const scenario::Scenario& scenario);

/// Returns the time of the last arrival, s; 0 if all grains are present from the start.
double end_of_arrivals(const scenario::Scenario& scenario);

/// Returns advice for a bed that did not come to rest in time, with the key that prevents it; `velocity` in g
/// h.
std::string advice_for_rest(const scenario::Scenario& scenario, double velocity);

}  // namespace talus::session
