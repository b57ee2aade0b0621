#include "io/writer_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>

#include "core/errors.h"
#include "core/locked_file.h"

namespace talus {
namespace {

std::string this_process() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return fmt::format("process {} on host {}", ::getpid(), host.data());
}

std::string holder(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  std::array<std::byte, 512> text{};
  const std::size_t size = file.get() < 0 ? 0 : read_at_most(file, text, path);
  return size > 0 ? std::string(reinterpret_cast<const char*>(text.data()), size) : "another process";
}

[[noreturn]] void refuse_held(const std::string& folder, const std::string& path) {
  throw Error(ExitCode::cannot_create,
              fmt::format("{} is being written by {}; wait for it to end, or choose another output with -o",
                          folder, holder(path)));
}

Descriptor lock(const std::string& folder, const std::string& path) {
  std::optional<Descriptor> file = create_locked(path);
  if (!file) refuse_held(folder, path);
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

void require_no_writer(const std::string& folder) {
  const std::string path = (std::filesystem::path(folder) / WriterLock::file_name).string();
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() >= 0 && ::flock(file.get(), LOCK_SH | LOCK_NB) != 0) refuse_held(folder, path);
}

}  // namespace talus
