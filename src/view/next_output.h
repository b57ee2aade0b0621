#pragma once
/// Names of run files for runs that begin anew.

#include <string>

namespace talus {

/// "slope-2.h5" after "slope.h5": the first that is not there yet.
std::string next_output(const std::string& first);

}  // namespace talus
