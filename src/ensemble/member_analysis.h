#pragma once
/// The analysis of a member whose run is not at hand, as far as its tables tell it.

#include "analysis/record.h"
#include "ensemble/averages.h"

namespace talus {

/// An analysis with all numbers of a run and of its frames that a member has left, and a frame for each row
/// of its series. What is no single number (distributions, fabric, grains) is empty, and what the tables do
/// not have is not known. It is that of the default parameters, with which members are analysed.
/// `mean_diameter`: D, m.
Analysis analysis_of(const MemberResult& member, double mean_diameter);

}  // namespace talus
