#include "render/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "core/errors.h"
#include "core/locked_file.h"

namespace talus {
namespace {

Descriptor create(const std::string& temporary, const std::string& path) {
  std::optional<Descriptor> file = create_locked(temporary);
  if (!file)
    throw Error(ExitCode::cannot_create,
                path + " is being written by another process; wait for it to end, or choose another output");
  return std::move(*file);
}

}  // namespace

OutputFile::OutputFile(const std::string& path)
    : path_(path), temporary_path_(path + ".part"), file_(create(temporary_path_, path_)) {}

OutputFile::~OutputFile() {
  if (!committed_) unlink(temporary_path_.c_str());
}

void OutputFile::write(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file_.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw system_error(ExitCode::io_error, "write", path_, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void OutputFile::commit() {
  while (fsync(file_.get()) != 0)
    if (errno != EINTR) throw system_error(ExitCode::io_error, "make durable (fsync)", path_, errno);
  if (std::rename(temporary_path_.c_str(), path_.c_str()) != 0) throw creation_error("create", path_, errno);
  committed_ = true;
}

}  // namespace talus
