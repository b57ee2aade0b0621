#include "io/writer_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/locked_file.h"

namespace talus::io {
namespace {

std::string this_process() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return fmt::format("process {} on host {}", ::getpid(), host.data());
}

std::string holder(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  std::array<std::byte, 512> text{};
  const std::size_t size = file.get() < 0 ? 0 : read_at_most(file, text, path);
  return size > 0 ? std::string(reinterpret_cast<const char*>(text.data()), size) : "another process";
}

[[noreturn]] void refuse_held(const std::string& folder, const std::string& writer) {
  throw Error(ExitCode::cannot_create,
              fmt::format("{} is being written by {}; wait for it to end, or choose another output with -o",
                          folder, writer));
}

Descriptor take_lock(const std::string& folder, const std::string& path) {
  std::optional<Descriptor> file = create_locked(path);
  if (!file) refuse_held(folder, holder(path));
  const std::string text = this_process();
  if (::pwrite(file->get(), text.data(), text.size(), 0) != static_cast<ssize_t>(text.size())) {
    const int error = errno;
    ::unlink(path.c_str());
    throw creation_error("write", path, error);
  }
  return std::move(*file);
}

}  // namespace

WriterLock::WriterLock(const std::string& folder)
    : folder_(folder),
      path_((std::filesystem::path(folder) / WriterLock::file_name).string()),
      file_(take_lock(folder, path_)) {}

WriterLock::~WriterLock() {
  if (file_.get() >= 0) ::flock(file_.get(), LOCK_UN);
}

bool WriterLock::is_held() const { return is_named(path_, file_); }

void WriterLock::remove() {
  if (is_held()) ::unlink(path_.c_str());
  file_.close();
}

void WriterLock::require() const {
  if (is_held()) return;
  throw Error(ExitCode::cannot_create,
              folder_ +
                  " was removed or replaced while it was being written, or another process has taken the run "
                  "over; nothing more is written there: start the run again");
}

std::string writer_of(const std::string& folder) {
  const std::string path = (std::filesystem::path(folder) / WriterLock::file_name).string();
  return is_locked(path).value_or(false) ? holder(path) : "";
}

void require_no_writer(const std::string& folder) {
  if (const std::string writer = writer_of(folder); !writer.empty()) refuse_held(folder, writer);
}

}  // namespace talus::io
