#include "io/durable_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "base/descriptor.h"
#include "base/errors.h"
#include "base/visible_text.h"

namespace talus::io {

std::vector<std::byte> read_file(const std::string& path) {
  // Avoids blocking on a pipe without a writer.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0)
    throw system_error(ExitCode::missing_input, "open", path, errno);
  if (!S_ISREG(status.st_mode))
    throw Error(
        ExitCode::missing_input,
        path + (S_ISDIR(status.st_mode) ? " is a folder" : " is a pipe or a device") + "; expected a file");
  std::vector<std::byte> bytes(static_cast<std::size_t>(status.st_size));
  bytes.resize(read_at_most(file, bytes, path));
  return bytes;
}

void write_durably(const std::string& path, std::span<const std::byte> bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.commit();
  sync_name(file.target());
}

std::string read_text(const std::string& path) {
  const std::vector<std::byte> bytes = read_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void write_text(const std::string& path, const std::string& text) {
  const std::string valid = utf8(text);
  write_durably(path, std::as_bytes(std::span(valid)));
}

void make_folder(const std::string& path) {
  if (::mkdir(path.c_str(), 0777) != 0 && errno != EEXIST)
    throw creation_error("create the folder", path, errno);
  sync_name(path);
}

void remove_file(const std::string& path) {
  if (::unlink(path.c_str()) != 0 && errno != ENOENT)
    throw system_error(ExitCode::io_error, "remove", path, errno);
}

}  // namespace talus::io
