#include "io/writer_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "core/errors.h"
#include "core/locked_file.h"

namespace talus {
namespace {

std::string this_process() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return "process " + std::to_string(::getpid()) + " on host " + host.data();
}

std::string holder(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  std::array<std::byte, 512> text{};
  const std::size_t size = file.get() < 0 ? 0 : read_at_most(file, text, path);
  return size > 0 ? std::string(reinterpret_cast<const char*>(text.data()), size) : "another process";
}

Descriptor lock(const std::string& folder, const std::string& path) {
  std::optional<Descriptor> file = create_locked(path);
  if (!file)
    throw Error(ExitCode::cannot_create, folder + " is being written by " + holder(path) +
                                             "; wait for it to end, or choose another output with -o");
  const std::string text = this_process();
  if (::pwrite(file->get(), text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
    throw creation_error("write", path, errno);
  return std::move(*file);
}

}  // namespace

WriterLock::WriterLock(const std::string& folder)
    : folder_(folder),
      path_((std::filesystem::path(folder) / WriterLock::file_name).string()),
      file_(lock(folder, path_)) {}

void WriterLock::require() const {
  if (is_named(path_, file_)) return;
  throw Error(ExitCode::cannot_create,
              folder_ +
                  " was removed or replaced while it was being written; nothing more is written there: "
                  "start the run again");
}

}  // namespace talus
