#include "render/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "core/errors.h"

namespace talus {

OutputFile::OutputFile(const std::string& path)
    : path_(path), temporary_path_(path + ".part-" + std::to_string(getpid())) {
  descriptor_ = open(temporary_path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0) throw system_error(ExitCode::cannot_create, "create", path_, errno);
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) close(descriptor_);
  if (!committed_) unlink(temporary_path_.c_str());
}

void OutputFile::write(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw system_error(ExitCode::io_error, "write", path_, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void OutputFile::commit() {
  const int closed = close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) throw system_error(ExitCode::io_error, "write", path_, errno);
  if (std::rename(temporary_path_.c_str(), path_.c_str()) != 0)
    throw system_error(ExitCode::cannot_create, "create", path_, errno);
  committed_ = true;
}

}  // namespace talus
