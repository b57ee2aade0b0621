#include "core/leftovers.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/descriptor.h"
#include "core/locked_file.h"
#include "core/output_file.h"
#include "core/paths.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

/// NAME of NAME.talus.part; empty where a name is no such one.
std::string name_before_ending(const std::string& name) {
  const bool is_temporary = name.ends_with(temporary_ending);
  return is_temporary ? name.substr(0, name.size() - std::string_view(temporary_ending).size()) : "";
}

/// What is under a name belongs to this user and is a file, or a folder.
bool is_own(const std::string& path, mode_t kind) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 && (status.st_mode & S_IFMT) == kind &&
         status.st_uid == ::geteuid();
}

/// A folder called NAME.talus.part, without a dot in NAME, is that of a figure where all that it holds are
/// files called NAME and something more. Others stay as they are.
void remove_figure_folder(const std::string& path) {
  const std::string name = name_before_ending(fs::path(path).filename().string());
  if (name.find('.') != std::string::npos) return;
  std::error_code unknown;
  const std::vector<std::string> files = names_in(path, unknown);
  const auto is_of_figure = [&](const std::string& file) {
    return file.starts_with(name) && is_own((fs::path(path) / file).string(), S_IFREG);
  };
  if (!std::ranges::all_of(files, is_of_figure)) return;
  for (const std::string& file : files) ::unlink((fs::path(path) / file).c_str());
  ::rmdir(path.c_str());
}

/// While the lock is shared nobody can take a file for writing, and while it is held by its writer it cannot
/// be shared. Who is about to lock a file that it has just made finds the lock shared, waits for it, sees
/// that the name is gone, and makes the file again (create_locked).
void clear(const std::string& path) {
  const bool is_file = is_own(path, S_IFREG);
  if (!is_file && !is_own(path, S_IFDIR)) return;
  const Descriptor left(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (left.get() < 0 || ::flock(left.get(), LOCK_SH | LOCK_NB) != 0 || !is_named(path, left)) return;
  if (is_file)
    ::unlink(path.c_str());
  else
    remove_figure_folder(path);
}

/// Whether other machines may write to the file system of a folder, to which the locks of this one need not
/// reach (statfs(2), and what the file systems themselves say).
bool is_shared_with_other_machines(const std::string& folder) {
  struct statfs system {};
  if (::statfs(folder.c_str(), &system) != 0) return true;
  constexpr std::array<std::uint32_t, 10> network = {
      0x6969,      // NFS
      0x517b,      // SMB
      0xff534d42,  // CIFS
      0xfe534d42,  // SMB 2
      0x0bd00bd0,  // Lustre
      0x47504653,  // GPFS
      0x00c36400,  // Ceph
      0x5346414f,  // AFS
      0x19830326,  // BeeGFS
      0x65735546,  // FUSE: sshfs and the like
  };
  return std::ranges::find(network, static_cast<std::uint32_t>(system.f_type)) != network.end();
}

}  // namespace

void clear_leftovers(const std::string& folder) {
  std::error_code unknown;
  std::vector<std::string> names = names_in(folder, unknown);
  std::erase_if(names, [](const std::string& name) { return name_before_ending(name).empty(); });
  if (names.empty() || is_shared_with_other_machines(folder)) return;
  // One process at a time: of two that share a lock one could remove what a third has made since.
  const Descriptor place(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (place.get() < 0 || ::flock(place.get(), LOCK_EX | LOCK_NB) != 0) return;
  for (const std::string& name : names) clear((fs::path(folder) / name).string());
}

}  // namespace talus
