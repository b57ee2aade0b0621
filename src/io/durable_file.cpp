#include "io/durable_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "core/errors.h"
#include "core/locked_file.h"

namespace talus {
namespace {

void write_all(int file, std::span<const std::byte> bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw system_error(ExitCode::io_error, "write", path, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void sync(int file, const std::string& path) {
  while (::fsync(file) != 0)
    if (errno != EINTR) throw system_error(ExitCode::io_error, "make durable (fsync)", path, errno);
}

}  // namespace

std::vector<std::byte> read_file(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0)
    throw system_error(ExitCode::missing_input, "open", path, errno);
  std::vector<std::byte> bytes(static_cast<std::size_t>(status.st_size));
  bytes.resize(read_at_most(file, bytes, path));
  return bytes;
}

void write_durably(const std::string& path, std::span<const std::byte> bytes, const std::string& temporary) {
  const std::optional<Descriptor> file = create_locked(temporary);
  if (!file)
    throw Error(ExitCode::cannot_create,
                path + " is being written by another process; wait for it to end, or choose another output");
  try {
    write_all(file->get(), bytes, temporary);
    sync(file->get(), temporary);
    if (::rename(temporary.c_str(), path.c_str()) != 0)
      throw system_error(ExitCode::io_error, "rename its temporary file to", path, errno);
  } catch (const Error&) {
    ::unlink(temporary.c_str());
    throw;
  }
  sync_name(path);
}

void make_folder(const std::string& path) {
  if (::mkdir(path.c_str(), 0777) != 0 && errno != EEXIST)
    throw creation_error("create the folder", path, errno);
  sync_name(path);
}

void sync_name(const std::string& path) {
  const Descriptor folder(::open(parent_folder(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.get() < 0) throw system_error(ExitCode::io_error, "open the folder of", path, errno);
  sync(folder.get(), path);
}

void remove_file(const std::string& path) {
  if (::unlink(path.c_str()) != 0 && errno != ENOENT)
    throw system_error(ExitCode::io_error, "remove", path, errno);
}

std::string parent_folder(const std::string& path) {
  const std::string parent = std::filesystem::path(path).parent_path().string();
  return parent.empty() ? "." : parent;
}

}  // namespace talus
