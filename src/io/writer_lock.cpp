#include "io/writer_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "core/errors.h"

namespace talus {
namespace {

std::string this_process() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return "process " + std::to_string(::getpid()) + " on host " + host.data();
}

std::string holder(const Descriptor& file, const std::string& path) {
  std::array<std::byte, 512> text{};
  const std::size_t size = read_at_most(file, text, path);
  return size > 0 ? std::string(reinterpret_cast<const char*>(text.data()), size) : "another process";
}

/// Whether `path` still names the open file: its last holder may have removed it while we waited for it.
bool names(const std::string& path, const Descriptor& file) {
  struct stat opened {
  }, named{};
  return ::fstat(file.get(), &opened) == 0 && ::stat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

void sign(const Descriptor& file, const std::string& path) {
  const std::string text = this_process();
  if (::ftruncate(file.get(), 0) != 0 ||
      ::pwrite(file.get(), text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
    throw system_error(ExitCode::cannot_create, "write", path, errno);
}

Descriptor lock(const std::string& folder) {
  const std::string path = (std::filesystem::path(folder) / WriterLock::file_name).string();
  for (;;) {
    Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
    if (file.get() < 0) throw system_error(ExitCode::cannot_create, "create", path, errno);
    if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0) {
      if (errno == EINTR) continue;
      if (errno != EWOULDBLOCK) throw system_error(ExitCode::cannot_create, "lock", path, errno);
      throw Error(ExitCode::cannot_create, folder + " is being written by " + holder(file, path) +
                                               "; wait for it to end, or choose another output with -o");
    }
    if (!names(path, file)) continue;
    sign(file, path);
    return file;
  }
}

}  // namespace

WriterLock::WriterLock(const std::string& folder) : file_(lock(folder)) {}

}  // namespace talus
