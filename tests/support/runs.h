#pragma once
/// Complete runs for tests that only read one or change a copy of it; each is made once and shared by all
/// tests.

#include <filesystem>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace talus::test {

/// Returns the packed file of the run that `talus run bed.toml`, with further arguments, makes of this
/// scenario. The first test that needs it makes it; it is kept in the build folder until the program changes.
/// Must not be modified.
std::filesystem::path kept_run(const std::string& scenario, const std::vector<std::string>& arguments = {});

/// Copies it into the folder and returns the path of the copy.
std::string take_run(const TemporaryFolder& folder, const std::string& name, const std::string& scenario,
                     const std::vector<std::string>& arguments = {});

}  // namespace talus::test
