#include "io/mistaken_path.h"

#include <algorithm>
#include <filesystem>
#include <fmt/core.h>
#include <vector>

#include "base/errors.h"
#include "base/paths.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "io/run_file.h"
#include "io/seal.h"

namespace talus::io {
namespace {

namespace fs = std::filesystem;

bool is_ensemble_folder(const std::string& path) {
  std::error_code unknown;
  return fs::exists(fs::path(path) / ensemble_manifest_name, unknown);
}

/// Returns the first run in a folder, such as "beds/seed-1.h5"; empty if there is none.
std::string first_run_in(const std::string& folder) {
  std::vector<std::string> runs;
  std::error_code unknown;
  for (const std::string& name : names_in(folder, unknown))
    if (const fs::path path = fs::path(folder) / name;
        path.extension() == ".h5" && begins_as_run(path.string()))
      runs.push_back(path.string());
  return runs.empty() ? std::string() : *std::ranges::min_element(runs);
}

[[noreturn]] void refuse_folder(const std::string& path) {
  const std::string run = first_run_in(path);
  const std::string example = run.empty() ? "" : ", such as " + run;
  if (is_ensemble_folder(path))
    throw Error(
        ExitCode::missing_input,
        fmt::format("{0} is the folder of an ensemble; expected one of its runs{1}; talus figures {0} "
                    "-o FOLDER draws all of them, and talus ensemble average {0} averages them",
                    path, example));
  throw Error(ExitCode::missing_input,
              fmt::format("{} is a folder, but not a run; expected a run file{}, or a folder RUN.h5.run",
                          path, example));
}

[[noreturn]] void refuse_file(const std::string& path) {
  const std::string what =
      fmt::format("{}: is not a Talus run file (it does not begin with '{}')", path, "talus run file 1");
  if (path.ends_with(".toml"))
    throw Error(ExitCode::bad_data,
                fmt::format("{} but, by its name, a scenario; talus run {} computes its run", what, path));
  if (begins_with(path, averages_seal))
    throw Error(ExitCode::bad_data, what + " but the averages of an ensemble; talus figures draws them");
  if (begins_with(path, hdf5_signature))
    throw Error(
        ExitCode::bad_data,
        what +
            " but an HDF5 file of another kind; talus solve reads contact problems, and talus ensemble "
            "average replaces an ensemble.h5 of an earlier version");
  throw Error(ExitCode::bad_data, what + "; expected one that talus run, view or replay has written");
}

}  // namespace

void refuse_no_run(const std::string& path) {
  std::error_code unknown;
  std::string folder = path;
  while (folder.size() > 1 && folder.ends_with('/')) folder.pop_back();
  if (!folder.ends_with(run_folder(""))) folder = run_folder(folder);
  if (fs::is_regular_file(path, unknown)) refuse_file(path);
  if (fs::is_directory(folder, unknown))
    throw Error(ExitCode::missing_input, folder +
                                             ": nothing is committed there yet; wait for the first "
                                             "checkpoint, or start its command again; if it was damaged, "
                                             "save what is undamaged with: talus repair");
  if (fs::is_directory(path, unknown)) refuse_folder(path);
  throw Error(ExitCode::missing_input,
              fmt::format("{}: no such run; expected a run file, or a folder {}", path, folder));
}

void refuse_no_averages(const std::string& path) {
  throw Error(
      ExitCode::bad_data,
      path +
          ": is not the ensemble.h5 of an ensemble (it does not begin with 'talus averages file 1'), or "
          "one of an earlier version of Talus; recreate it with: talus ensemble average FOLDER");
}

void refuse_no_scenario(const std::string& path) {
  std::string run = path;
  while (run.size() > 1 && run.ends_with('/')) run.pop_back();
  if (run.ends_with(run_folder(""))) run.resize(run.size() - run_folder("").size());
  std::error_code unknown;
  const bool is_scenario = fs::is_regular_file(path, unknown) && !begins_as_run(path);
  if (is_scenario) return;
  const RunPresence presence = run_presence(run);
  if (presence == RunPresence::folder)
    throw Error(ExitCode::bad_data,
                fmt::format("{} is not a scenario but an incomplete run, now at {} deg; resume "
                            "it with: talus run --resume {}",
                            path, degrees_text(RunFile::open(run).checkpoint().world.tilt, 3), run));
  if (presence == RunPresence::packed && begins_as_run(run))
    throw Error(ExitCode::bad_data,
                fmt::format("{} is not a scenario but a complete run; talus info {} shows what it holds, and "
                            "talus replay {} computes it again",
                            path, run, run));
  if (is_ensemble_folder(path))
    throw Error(
        ExitCode::bad_data,
        fmt::format("{0} is not a scenario but the folder of an ensemble; talus ensemble work {0} resumes "
                    "it",
                    path));
}

}  // namespace talus::io
