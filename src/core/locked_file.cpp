#include "core/locked_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <fmt/core.h>
#include <system_error>
#include <thread>
#include <utility>

#include "core/errors.h"

namespace talus {
namespace {

/// Others may make and remove a file of the same name while one is being made. Where it never is what was
/// opened, as on a file system that numbers its files anew at each look, this is where to give up.
constexpr int attempts = 100;

[[noreturn]] void give_up(const std::string& path) {
  throw Error(
      ExitCode::cannot_create,
      fmt::format("{}: cannot lock: it was replaced by another file at each of {} attempts; choose an "
                  "output on another file system",
                  path, attempts));
}

/// The error of the first lock that the file system refused.
std::atomic<int>& lock_problem() {
  static std::atomic<int> error = 0;
  return error;
}

/// False if others hold the file in a way that does not allow this lock. Where the file system refuses it for
/// any other reason than a disk that is full or fails, it has no locks, and the file is used without one.
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

/// False if another process writes the file. Who clears it away shares its lock, and has done so in a moment:
/// that is waited for.
bool take_lock(const Descriptor& file, const std::string& path) {
  return lock(file, LOCK_EX | LOCK_NB, path) ||
         (lock(file, LOCK_SH | LOCK_NB, path) && lock(file, LOCK_EX, path));
}

/// Whether a file or folder was left under a name by a process that was killed: no link, no device.
bool is_left(const std::string& path, mode_t kind) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 && (status.st_mode & S_IFMT) == kind;
}

/// What is there stays: Talus has not made it.
[[noreturn]] void refuse_foreign(const std::string& path, const char* expected) {
  throw Error(ExitCode::cannot_create,
              path + " is in the way: Talus needs this name for a moment, for " + expected +
                  ", and has not made what is there; remove it, or choose another output");
}

/// Opens what has this name without following a link, and without waiting for the other end of a FIFO.
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

std::string take_lock_problem() {
  constexpr int told = -1;
  const int error = lock_problem();
  if (error <= 0) return "";
  lock_problem() = told;
  return std::generic_category().message(error);
}

std::optional<Descriptor> create_locked(const std::string& path) {
  for (int attempt = 0; attempt < attempts; ++attempt) {
    Descriptor made(::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (made.get() < 0 && errno != EEXIST) throw creation_error("create", path, errno);
    const bool found = made.get() < 0;
    if (found && !is_left(path, S_IFREG)) {
      if (errno == ENOENT) continue;  // removed at this very moment
      refuse_foreign(path, "a temporary file");
    }
    Descriptor file = found ? open_found(path, O_RDWR) : std::move(made);
    if (file.get() < 0 && errno == ENOENT) continue;
    if (file.get() < 0) throw creation_error("create", path, errno);
    if (!take_lock(file, path)) return std::nullopt;
    if (!is_named(path, file)) continue;  // its last holder has renamed or removed it
    if (!found) return file;
    if (::unlink(path.c_str()) != 0) throw creation_error("replace", path, errno);
  }
  give_up(path);
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

std::optional<Descriptor> create_locked_folder(const std::string& path) {
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const bool made = ::mkdir(path.c_str(), 0777) == 0;
    if (!made && errno != EEXIST) throw creation_error("create the folder", path, errno);
    if (!made && !is_left(path, S_IFDIR)) {
      if (errno == ENOENT) continue;
      refuse_foreign(path, "a temporary folder");
    }
    Descriptor folder = open_found(path, O_RDONLY | O_DIRECTORY);
    if (folder.get() < 0 && errno == ENOENT) continue;
    if (folder.get() < 0) throw creation_error("open the folder", path, errno);
    if (!take_lock(folder, path)) return std::nullopt;
    if (!is_named(path, folder)) continue;
    if (made) return folder;
    std::error_code error;
    std::filesystem::remove_all(path, error);
    if (error) throw creation_error("replace the folder", path, error.value());
  }
  give_up(path);
}

}  // namespace talus
