#pragma once
/// The analysis of a member whose run is not at hand, as far as its tables tell it.

#include "analysis/record.h"
#include "ensemble/averages.h"
#include "runs/run_view.h"

namespace talus {

/// An analysis with all numbers of a run and of its frames that a member has left, and a frame for each row
/// of its series. What is no single number (distributions, fabric, grains) is empty, and what the tables do
/// not have is not known. It is that of the default parameters, with which members are analysed.
/// `mean_diameter`: D, m.
Analysis analysis_of(const MemberResult& member, double mean_diameter);

/// A member as a run whose file is not there. `path` is what it is called; `scenario_text` that of its
/// variant, which may have another seed. Throws Error(bad_data) where the scenario cannot be read.
RunView view_of_values(const std::string& path, const MemberResult& member, const std::string& scenario_text);

}  // namespace talus
