#pragma once
/// Complete runs for tests that only read one, or change a copy of it: made once, whichever tests need them.

#include <filesystem>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace talus::test {

/// The packed file of the run that `talus run bed.toml`, with more arguments, makes of this scenario. The
/// first test that needs it makes it; it is kept in the build folder until the program changes. Not to be
/// changed.
std::filesystem::path kept_run(const std::string& scenario, const std::vector<std::string>& arguments = {});

/// Puts a copy of it in the folder and returns its path.
std::string take_run(const TemporaryFolder& folder, const std::string& name, const std::string& scenario,
                     const std::vector<std::string>& arguments = {});

}  // namespace talus::test
