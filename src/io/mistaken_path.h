#pragma once
/// Messages about a path at which something else is found than was expected, with the command that accepts
/// it.

#include <string>

namespace talus::io {

/// The file that identifies the folder of an ensemble.
inline constexpr const char* ensemble_manifest_name = "ensemble.manifest";

/// Throws because a run was expected at `path`: Error(missing_input) if nothing is there, or a folder that is
/// not a run, such as that of an ensemble; Error(bad_data) if it is a file of another kind.
[[noreturn]] void refuse_no_run(const std::string& path);

/// Throws Error(bad_data) because the averages of an ensemble were expected at `path`.
[[noreturn]] void refuse_no_averages(const std::string& path);

/// Throws Error(bad_data) if `path`, where a scenario is expected, is a run, complete or not, or an ensemble.
/// Returns for everything else, which the parser of scenarios reports.
void refuse_no_scenario(const std::string& path);

}  // namespace talus::io
