#include "io/trial_walk.h"

#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <mutex>
#include <set>
#include <tuple>
#include <vector>

#include "base/errors.h"
#include "io/child_process.h"
#include "io/hdf5_reader.h"
#include "io/manifest.h"
#include "io/run_file.h"

namespace talus::io {
namespace {

std::atomic<bool> walks_first = false;

/// Device, inode, size and time of the last change: the bytes of a file stay the same with them.
using Identity = std::tuple<dev_t, ino_t, off_t, time_t, long>;

std::mutex tried_mutex;
std::set<Identity> tried;  // guarded by tried_mutex

/// Returns the files of a run; none if the manifest of its folder cannot be read.
std::vector<std::string> files_of_run(const std::string& run) try {
  std::error_code unknown;
  if (!std::filesystem::is_directory(run, unknown)) return {run};
  std::vector<std::string> paths;
  for (const StoredFile& file : files_of(read_manifest(run)))
    paths.push_back((std::filesystem::path(run) / file.name).string());
  return paths;
} catch (const Error&) {
  return {};
}

/// Returns the identities of the files that exist, and adds their sizes to `bytes`.
std::set<Identity> identities_of(const std::vector<std::string>& files, std::size_t& bytes) {
  std::set<Identity> identities;
  for (const std::string& file : files) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) continue;
    identities.emplace(status.st_dev, status.st_ino, status.st_size, status.st_mtim.tv_sec,
                       status.st_mtim.tv_nsec);
    bytes += static_cast<std::size_t>(status.st_size);
  }
  return identities;
}

bool were_tried(const std::set<Identity>& identities) {
  const std::scoped_lock lock(tried_mutex);
  return std::ranges::includes(tried, identities);
}

}  // namespace

bool walk_before_opening() { return walks_first = true; }

void try_run(const std::string& run) {
  if (!walks_first) return;
  std::size_t bytes = 0;
  const std::vector<std::string> files = files_of_run(run);
  const std::set<Identity> identities = identities_of(files, bytes);
  if (were_tried(identities)) return;
  const auto walk = [&] {
    walks_first = false;  // in the child
    try {
      for (const std::string& file : files) hdf5::Reader::from_file(file).walk();
      RunFile::open(run);
    } catch (const Error&) {  // this process reports it
    }
    return Parcels();
  };
  try {
    in_child_process(run, bytes, walk);
  } catch (const Error& error) {
    if (error.code() != ExitCode::bad_data) return;  // there is no child process
    throw Error(
        ExitCode::bad_data,
        run +
            ": HDF5 crashes or hangs on this run: it is malformed, although its hash is right; restore it "
            "from a copy");
  }
  const std::scoped_lock lock(tried_mutex);
  tried.insert(identities.begin(), identities.end());
}

}  // namespace talus::io
