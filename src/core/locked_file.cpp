#include "core/locked_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "core/errors.h"

namespace talus {
namespace {

/// False where another process holds the file.
bool take_lock(const Descriptor& file, const std::string& path) {
  while (::flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return false;
    if (errno != EINTR) throw creation_error("lock", path, errno);
  }
  return true;
}

}  // namespace

bool is_named(const std::string& path, const Descriptor& file) {
  struct stat opened {
  }, named{};
  return ::fstat(file.get(), &opened) == 0 && ::stat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

std::optional<Descriptor> create_locked(const std::string& path) {
  for (;;) {
    Descriptor made(::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (made.get() < 0 && errno != EEXIST) throw creation_error("create", path, errno);
    const bool found = made.get() < 0;
    Descriptor file = found ? Descriptor(::open(path.c_str(), O_RDWR | O_CLOEXEC)) : std::move(made);
    if (file.get() < 0 && errno == ENOENT) continue;  // gone in this moment
    if (file.get() < 0) throw creation_error("create", path, errno);
    if (!take_lock(file, path)) return std::nullopt;
    if (!is_named(path, file)) continue;  // its last holder has renamed or removed it
    if (!found) return file;
    if (::unlink(path.c_str()) != 0) throw creation_error("replace", path, errno);
  }
}

}  // namespace talus
