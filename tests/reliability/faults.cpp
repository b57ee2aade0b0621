#include "reliability/faults.h"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>

namespace talus::faults {
namespace {

Fault armed;
int counted = 0;
bool counting = false;

/// Counts a call; true where it must fail, with errno set.
bool strikes() {
  if (!counting) return false;
  ++counted;
  if (armed.kind == Kind::none || counted < armed.call || (counted > armed.call && !armed.lasting))
    return false;
  if (armed.kind == Kind::kill) _exit(killed);
  errno = armed.errno_value;
  return true;
}

/// A kill can split a write.
void split_write(int file, const void* data, size_t size) {
  if (counting && armed.kind == Kind::kill && counted + 1 == armed.call)
    syscall(SYS_write, file, data, size / 2);
}

}  // namespace

void arm(const Fault& fault) {
  armed = fault;
  counted = 0;
  counting = true;
}

int calls() { return counted; }

}  // namespace talus::faults

using talus::faults::strikes;

extern "C" {

int open(const char* path, int flags, ...) {
  mode_t mode = 0;
  if ((flags & O_CREAT) != 0) {
    va_list arguments;
    va_start(arguments, flags);
    mode =
        va_arg(arguments, mode_t);  // NOLINT(clang-analyzer-valist.Uninitialized): it does not see va_start
    va_end(arguments);
  }
  return strikes() ? -1 : static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}
ssize_t read(int file, void* data, size_t size) {
  return strikes() ? -1 : syscall(SYS_read, file, data, size);
}
ssize_t write(int file, const void* data, size_t size) {
  talus::faults::split_write(file, data, size);
  return strikes() ? -1 : syscall(SYS_write, file, data, size);
}
int fsync(int file) { return strikes() ? -1 : static_cast<int>(syscall(SYS_fsync, file)); }
int rename(const char* from, const char* to) noexcept {
  return strikes() ? -1 : static_cast<int>(syscall(SYS_rename, from, to));
}
int unlink(const char* path) noexcept { return strikes() ? -1 : static_cast<int>(syscall(SYS_unlink, path)); }
int mkdir(const char* path, mode_t mode) noexcept {
  return strikes() ? -1 : static_cast<int>(syscall(SYS_mkdir, path, mode));
}
int rmdir(const char* path) noexcept { return strikes() ? -1 : static_cast<int>(syscall(SYS_rmdir, path)); }
}
