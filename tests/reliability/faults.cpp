#include "reliability/faults.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <utility>

namespace talus::faults {
namespace {

Fault armed;
int counted = 0;
char first_struck[256] = "";
pid_t counting = 0;  ///< process whose calls are counted, without its children

}  // namespace

bool counts_in_process() { return counting == getpid(); }

namespace {

/// Counts a call; returns whether the fault applies to it.
bool is_next() {
  if (!counts_in_process()) return false;
  ++counted;
  return armed.kind != Kind::none && (counted == armed.call || (counted > armed.call && armed.lasting));
}

bool strike(const char* call, const char* path) {
  if (armed.kind == Kind::kill) _exit(killed);
  if (armed.kind == Kind::visit) {
    std::exchange(armed, {}).visit();
    return false;
  }
  if (first_struck[0] == '\0') std::snprintf(first_struck, sizeof first_struck, "%s %s", call, path);
  errno = armed.errno_value;
  return true;
}

}  // namespace

bool strikes(const char* call, const char* path) { return is_next() && strike(call, path); }

bool strikes_opening(const char* path) {
  constexpr std::string_view nowhere = "/dev/null/";
  return std::strncmp(path, nowhere.data(), nowhere.size()) != 0 && strikes("open", path);
}

bool strikes_reading(const char* call) {
  return is_next() && (armed.kind == Kind::kill || armed.errno_value != ENOSPC) && strike(call, "");
}

namespace {

/// Writes only part of the data, as a kill can split a write.
void split_write(int file, const void* data, size_t size) {
  if (counts_in_process() && armed.kind == Kind::kill && counted + 1 == armed.call)
    syscall(SYS_write, file, data, size / 2);
}

}  // namespace

bool has_no_locks() {
  if (armed.kind != Kind::no_locks) return false;
  errno = armed.errno_value;
  return true;
}

namespace {

constexpr int max_files = 256;

/// File that was removed while it was open.
struct KeptFile {
  char path[4096];
  struct stat status;
};
KeptFile kept[16];
int kept_count = 0;

bool is_same(const struct stat& left, const struct stat& right) {
  return left.st_dev == right.st_dev && left.st_ino == right.st_ino;
}

bool is_open(const struct stat& status) {
  struct stat opened {};
  for (int file = 3; file < max_files; ++file)
    if (fstat(file, &opened) == 0 && is_same(opened, status)) return true;
  return false;
}

}  // namespace

int unlink_kept(const char* path) {
  struct stat status {};
  if (armed.kind != Kind::keeps_open || lstat(path, &status) != 0 || !is_open(status) || kept_count == 16)
    return static_cast<int>(syscall(SYS_unlink, path));
  KeptFile& file = kept[kept_count++];
  file.status = status;
  const char* const slash = std::strrchr(path, '/');
  const int folder = slash == nullptr ? 0 : static_cast<int>(slash - path) + 1;
  std::snprintf(file.path, sizeof file.path, "%.*s.nfs%lx", folder, path,
                static_cast<unsigned long>(status.st_ino));
  return static_cast<int>(syscall(SYS_rename, path, file.path));
}

int close_kept(int file) {
  const int result = static_cast<int>(syscall(SYS_close, file));
  for (int k = 0; k < kept_count; ++k)
    if (!is_open(kept[k].status)) {
      syscall(SYS_unlink, kept[k].path);
      kept[k] = kept[--kept_count];
    }
  return result;
}

void arm(const Fault& fault) {
  armed = fault;
  counted = 0;
  first_struck[0] = '\0';
  counting = getpid();
}

int calls() { return counted; }
const char* struck() { return first_struck; }

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
  return talus::faults::strikes_opening(path)
             ? -1
             : static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, mode));
}
ssize_t read(int file, void* data, size_t size) {
  return talus::faults::strikes_reading("read") ? -1 : syscall(SYS_read, file, data, size);
}
ssize_t write(int file, const void* data, size_t size) {
  talus::faults::split_write(file, data, size);
  return strikes("write") ? -1 : syscall(SYS_write, file, data, size);
}
ssize_t pwrite(int file, const void* data, size_t size, off_t at) {
  return strikes("pwrite") ? -1 : syscall(SYS_pwrite64, file, data, size, at);
}
int lock_file(int file, int operation) noexcept __asm__("flock");  // a struct has the same name
int lock_file(int file, int operation) noexcept {
  return talus::faults::has_no_locks() || strikes("flock")
             ? -1
             : static_cast<int>(syscall(SYS_flock, file, operation));
}
int fsync(int file) { return strikes("fsync") ? -1 : static_cast<int>(syscall(SYS_fsync, file)); }
int rename(const char* from, const char* to) noexcept {
  return strikes("rename", to) ? -1 : static_cast<int>(syscall(SYS_rename, from, to));
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept {
  return strikes("rename", to)
             ? -1
             : static_cast<int>(syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}
int unlink(const char* path) noexcept {
  return strikes("unlink", path) ? -1 : talus::faults::unlink_kept(path);
}
int close(int file) { return talus::faults::close_kept(file); }
int mkdir(const char* path, mode_t mode) noexcept {
  return strikes("mkdir", path) ? -1 : static_cast<int>(syscall(SYS_mkdir, path, mode));
}
int rmdir(const char* path) noexcept {
  return strikes("rmdir", path) ? -1 : static_cast<int>(syscall(SYS_rmdir, path));
}
}
