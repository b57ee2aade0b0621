#include "base/locked_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "base/errors.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

/// Number of attempts to create a file before giving up. Other processes may create and remove a file of the
/// same name meanwhile. On a file system that renumbers its files at each access, the name never matches the
/// open file.
constexpr int attempts = 100;

/// Error of the first lock that the file system refused; 0: none.
std::atomic<int>& lock_problem() {
  static std::atomic<int> error = 0;
  return error;
}

/// Locks a file; returns false if other processes hold a lock that excludes this one. If the file system
/// refuses the lock for any reason except a full or failing disk, it has no locks, and the file is used
/// without one.
bool lock(const Descriptor& file, int operation, const std::string& path) {
  while (::flock(file.get(), operation) != 0) {
    if (errno == EWOULDBLOCK) return false;
    if (errno == EINTR) continue;
    const int error = errno;
    const Error refused = creation_error("lock", path, error);
    if (refused.code() == ExitCode::io_error) throw Error(refused);
    int none = 0;
    lock_problem().compare_exchange_strong(none, error);
    return true;
  }
  return true;
}

/// Acquires the lock for writing; returns false if another process writes the file. A process that removes
/// the file shares its lock for a moment, so this function waits for it.
bool acquire_lock(const Descriptor& file, const std::string& path) {
  return lock(file, LOCK_EX | LOCK_NB, path) ||
         (lock(file, LOCK_SH | LOCK_NB, path) && lock(file, LOCK_EX, path));
}

/// Whether a path is of the given kind (file or folder) itself, and not a link to one, and, if `ours`,
/// belongs to this user.
bool is_of_kind(const std::string& path, mode_t kind, bool ours) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 && (status.st_mode & S_IFMT) == kind &&
         (!ours || status.st_uid == ::geteuid());
}

/// Opens a path without following a link, and without waiting for the other end of a FIFO.
Descriptor open_found(const std::string& path, int flags) {
  return Descriptor(::open(path.c_str(), flags | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
}

}  // namespace

bool is_named(const std::string& path, const Descriptor& file) {
  struct stat opened {
  }, named{};
  return ::fstat(file.get(), &opened) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

std::optional<bool> is_locked(const std::string& path) {
  const Descriptor file = open_found(path, O_RDONLY);
  if (file.get() < 0 || ::flock(file.get(), LOCK_SH | LOCK_NB) == 0) return false;
  if (errno == EWOULDBLOCK) return true;
  return std::nullopt;
}

std::string fetch_lock_problem() {
  constexpr int reported = -1;
  const int error = lock_problem();
  if (error <= 0) return "";
  lock_problem() = reported;
  return std::generic_category().message(error);
}

std::optional<Descriptor> create_locked(const std::string& path) {
  for (int attempt = 0; attempt < attempts; ++attempt) {
    Descriptor made(::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    const bool is_new = made.get() >= 0;
    if (!is_new && errno != EEXIST) throw creation_error("create", path, errno);
    if (!is_new && !is_of_kind(path, S_IFREG, false)) {
      if (errno == ENOENT) continue;  // removed meanwhile
      throw Error(ExitCode::cannot_create,
                  path +
                      " is in the way: Talus needs this name for a temporary file, and did not "
                      "create the existing one; remove it, or choose another output");
    }
    Descriptor file = is_new ? std::move(made) : open_found(path, O_RDWR);
    if (file.get() < 0 && errno == ENOENT) continue;
    if (file.get() < 0) throw creation_error("open", path, errno);
    if (!acquire_lock(file, path)) return std::nullopt;
    if (!is_named(path, file)) continue;  // its last holder has renamed or removed it
    if (is_new) return file;
    if (::unlink(path.c_str()) != 0 && errno != ENOENT) throw creation_error("replace", path, errno);
  }
  throw Error(ExitCode::cannot_create,
              "{}: cannot lock: it was replaced by another file at each of {} attempts; choose an "
              "output on another file system",
              path, attempts);
}

void while_locked(const std::string& path, const std::function<void()>& work) {
  std::optional<Descriptor> file;
  while (!(file = create_locked(path))) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const auto remove = [&] {
    if (is_named(path, *file)) ::unlink(path.c_str());
  };
  try {
    work();
  } catch (...) {
    remove();
    throw;
  }
  remove();
}

namespace {

/// Returns NAME of NAME.talus.part; empty for any other name.
std::string name_before_ending(const std::string& name) {
  const bool is_temporary = name.ends_with(temporary_ending);
  return is_temporary ? name.substr(0, name.size() - std::string_view(temporary_ending).size()) : "";
}

/// Removes a folder NAME.talus.part, without a dot in NAME, if it is that of a figure: the names of all files
/// in it begin with NAME. Other folders are left in place.
void remove_figure_folder(const std::string& path) {
  const std::string name = name_before_ending(fs::path(path).filename().string());
  if (name.find('.') != std::string::npos) return;
  std::error_code unknown;
  const std::vector<std::string> files = names_in(path, unknown);
  const auto is_of_figure = [&](const std::string& file) {
    return file.starts_with(name) && is_of_kind(path_in(path, file), S_IFREG, true);
  };
  if (!std::ranges::all_of(files, is_of_figure)) return;
  for (const std::string& file : files) ::unlink(path_in(path, file).c_str());
  ::rmdir(path.c_str());
}

/// Removes a leftover whose lock is free. A shared lock excludes writers, and a lock held by a writer cannot
/// be shared. A process about to lock a file that it has just created finds the lock shared, waits, finds
/// that the name no longer exists, and creates another file (create_locked).
void clear(const std::string& path) {
  const bool is_file = is_of_kind(path, S_IFREG, true);
  if (!is_file && !is_of_kind(path, S_IFDIR, true)) return;
  const Descriptor left = open_found(path, O_RDONLY);
  if (left.get() < 0 || ::flock(left.get(), LOCK_SH | LOCK_NB) != 0 || !is_named(path, left)) return;
  if (is_file)
    ::unlink(path.c_str());
  else
    remove_figure_folder(path);
}

/// Whether other machines may write to the file system of a folder, so that locks of this machine need not be
/// visible to them. The numbers are those of statfs(2) and of the file systems' headers.
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
  // One process at a time: of two processes that share a lock, one could remove a file made by a third since.
  const Descriptor place(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (place.get() < 0 || ::flock(place.get(), LOCK_EX | LOCK_NB) != 0) return;
  for (const std::string& name : names) clear(path_in(folder, name));
}

}  // namespace talus
