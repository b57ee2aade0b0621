#include "app/given_runs.h"

#include <filesystem>
#include <fmt/core.h>

#include "app/terminal.h"
#include "base/errors.h"
#include "io/seal.h"

namespace talus::app {

std::vector<std::string> runs_among(const std::vector<std::string>& paths,
                                    bool (*is_wanted_too)(const std::string&)) {
  if (paths.size() < 2) return paths;
  std::vector<std::string> runs;
  for (const std::string& path : paths) {
    std::error_code unknown;
    const bool is_other = std::filesystem::is_regular_file(path, unknown) && !io::begins_as_run(path) &&
                          (is_wanted_too == nullptr || !is_wanted_too(path));
    if (is_other)
      print_error("left out: %s is no run\n", path.c_str());
    else
      runs.push_back(path);
  }
  if (runs.empty())
    throw Error(ExitCode::bad_data, fmt::format("none of these {} files is a run", paths.size()));
  return runs;
}

}  // namespace talus::app
