#pragma once
/// The paper's beds, and its periodic bed prepared in other ways.

#include <vector>

#include "ensemble/plan.h"

namespace talus::ensemble {

/// Returns the periodic bed with three preparations (deposition.method: poured, geometric, collapse), the
/// paper's first, and five beds between walls. `quick`: H = 20 D, with L = 50 ... 150 D between walls, which
/// keeps the paper's H / L, and L = 100 D for the periodic bed.
std::vector<Variant> paper_beds(bool quick);

}  // namespace talus::ensemble
