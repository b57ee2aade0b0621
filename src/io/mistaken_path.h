#pragma once
/// What is said of a path at which something else is found than was expected, and which command takes it.

#include <string>

namespace talus::io {

/// The file in the folder of an ensemble by which it is known.
inline constexpr const char* ensemble_manifest_name = "ensemble.manifest";

/// Throws because a run was expected at `path` and none is there: Error(missing_input) if nothing is there,
/// or a folder that is no run, such as that of an ensemble; Error(bad_data) if it is a file of another kind.
[[noreturn]] void refuse_no_run(const std::string& path);

/// Throws Error(bad_data) because the averages of an ensemble were expected at `path`.
[[noreturn]] void refuse_no_averages(const std::string& path);

/// Throws Error(bad_data) if a scenario was expected at `path` and a run is there, complete or not, or an
/// ensemble. Returns for everything else, of which reading it as a scenario tells.
void refuse_no_scenario(const std::string& path);

}  // namespace talus::io
