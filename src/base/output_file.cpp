#include "base/output_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>
#include <map>
#include <mutex>

#include "base/errors.h"
#include "base/locked_file.h"

namespace talus {

bool Descriptor::close() {
  const int file = std::exchange(file_, -1);
  return file < 0 || ::close(file) == 0;
}

std::size_t read_at_most(const Descriptor& file, std::span<std::byte> buffer, const std::string& path) {
  std::size_t done = 0;
  while (done < buffer.size()) {
    const ssize_t count = ::read(file.get(), buffer.data() + done, buffer.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw system_error(ExitCode::io_error, "read", path, errno);
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  return done;
}

namespace fs = std::filesystem;

bool is_there(const std::string& path) {
  std::error_code unknown;
  return fs::exists(path, unknown);
}

bool is_file(const std::string& path) {
  std::error_code unknown;
  return fs::is_regular_file(path, unknown);
}

bool is_folder(const std::string& path) {
  std::error_code unknown;
  return fs::is_directory(path, unknown);
}

std::optional<FileMark> mark_of_file(const std::string& path) {
  struct stat file {};
  if (::stat(path.c_str(), &file) != 0) return std::nullopt;
  return FileMark{file.st_dev, file.st_ino, static_cast<std::uint64_t>(file.st_size), file.st_mtim.tv_sec,
                  file.st_mtim.tv_nsec};
}

std::string path_in(const std::string& folder, std::string_view name) {
  return (fs::path(folder) / name).string();
}

std::string absolute_path(const std::string& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error);
  return error ? path : whole.string();
}

std::string resolved_path(const std::string& path) {
  std::error_code error;
  // Absolute first, because weakly_canonical leaves a relative path relative if none of it exists.
  const std::string whole = absolute_path(path);
  const fs::path resolved = fs::weakly_canonical(whole, error);
  return error ? fs::path(whole).lexically_normal().string() : resolved.string();
}

std::vector<std::string> names_in(const std::string& folder, std::error_code& error) {
  std::vector<std::string> names;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    names.push_back(entry->path().filename().string());
  if (error) names.clear();
  return names;
}

std::vector<std::string> names_in(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> names = names_in(folder, error);
  if (error) throw system_error(ExitCode::io_error, "read the folder", folder, error.value());
  return names;
}

namespace {

const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISFIFO(mode)) return "a FIFO";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

bool is_same(const struct stat& file, const std::string& path) {
  struct stat other {};
  return ::stat(path.c_str(), &other) == 0 && other.st_dev == file.st_dev && other.st_ino == file.st_ino;
}

/// Whether a file is one of the inputs, or is in one of them.
bool is_input(const struct stat& file, const std::string& target, const OutputRule& rule) {
  struct stat folder {};
  const bool has_folder = ::stat(parent_folder(target).c_str(), &folder) == 0;
  for (const std::string& input : rule.inputs)
    if (is_same(file, input) || (has_folder && is_same(folder, input))) return true;
  return false;
}

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw Error(ExitCode::cannot_create, path + reason);
}

/// Returns the target of a link. Throws for /dev/stdout and the like, which lead to files opened by a shell:
/// these must not be replaced.
std::string end_of_link(const std::string& path) {
  std::error_code error;
  const fs::path next = fs::read_symlink(path, error), folder = fs::canonical(parent_folder(path), error);
  if (next.string().starts_with("/proc/") || folder.string().starts_with("/proc/"))
    refuse(path, " is an open file of a process; choose another output with -o");
  fs::path target = fs::canonical(path, error);
  if (error)
    refuse(path, " is a link that cannot be followed (" + error.message() +
                     "); remove it, or choose another output with -o");
  return target.string();
}

/// Describes the write protection of a file; empty if it has none. Renaming does not require permission to
/// write the replaced file, but the user has protected it.
std::string write_protection(const std::string& target, const struct stat& file) {
  if ((file.st_mode & 0222) != 0 && ::access(target.c_str(), W_OK) == 0) return {};
  return fmt::format("is write-protected (mode {:04o})", file.st_mode & 07777);
}

/// Names that output_target has found free for outputs of this process that must not replace a file, each
/// with advice for the case that one has appeared.
std::mutex free_names_mutex;
std::map<std::string, std::string> free_names;  // guarded by free_names_mutex

std::optional<std::string> advice_if_kept_free(const std::string& path) {
  const std::scoped_lock lock(free_names_mutex);
  const auto name = free_names.find(absolute_path(path));
  return name == free_names.end() ? std::nullopt : std::optional(name->second);
}

/// Renames a file if no file has the new name; returns false, with the reason in errno, if it cannot.
bool rename_to_free(const std::string& from, const std::string& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS) return false;  // network file systems do not know the flag
  if (::link(from.c_str(), to.c_str()) == 0) return ::unlink(from.c_str()) == 0;
  if (errno == EEXIST) return false;
  struct stat file {};  // the file system has no links
  if (::lstat(to.c_str(), &file) == 0) errno = EEXIST;
  return errno != EEXIST && std::rename(from.c_str(), to.c_str()) == 0;
}

/// Gives a complete file its final name; returns false, with the reason in errno, if the system refuses.
bool take_name(const std::string& from, const std::string& target, const std::string& path) {
  const std::optional<std::string> advice = advice_if_kept_free(path);
  if (!advice) return std::rename(from.c_str(), target.c_str()) == 0;
  if (rename_to_free(from, target)) {
    allow_replacing(path);  // by the next output of this process
    return true;
  }
  if (errno == EEXIST)
    refuse(path, " was created by another process in the meantime, and is kept; " + *advice);
  return false;
}

}  // namespace

void keep_free(const std::string& path, const std::string& advice) {
  const std::scoped_lock lock(free_names_mutex);
  free_names.insert_or_assign(absolute_path(path), advice);
}

void allow_replacing(const std::string& path) {
  const std::scoped_lock lock(free_names_mutex);
  free_names.erase(absolute_path(path));
}

std::string output_target(const std::string& path, const OutputRule& rule) {
  if (path.empty()) throw Error(ExitCode::usage, "the output has an empty name; give one with -o");
  struct stat file {};
  if (::lstat(path.c_str(), &file) != 0) {
    if (errno != ENOENT && errno != ENOTDIR) throw creation_error("create", path, errno);
    if (path.back() == '/') refuse(path, " names a folder; choose a file as the output with -o");
    if (!rule.overwrite) keep_free(path);
    return path;
  }
  std::string target = S_ISLNK(file.st_mode) ? end_of_link(path) : path;
  if (::stat(target.c_str(), &file) != 0) throw creation_error("replace", path, errno);
  if (!S_ISREG(file.st_mode))
    refuse(path, std::string(" is ") + kind_of(file.st_mode) + "; choose another output with -o");
  if (is_input(file, target, rule))
    throw Error(
        rule.overwrite ? ExitCode::usage : ExitCode::cannot_create,
        path + " is read by this command and cannot be its output as well; choose another output with -o");
  if (!rule.overwrite) refuse(path, " exists; give --overwrite to replace it, or another -o");
  if (const std::string reason = write_protection(target, file); !reason.empty())
    refuse(path, " " + reason + "; chmod u+w makes it writable, or choose another output with -o");
  return target;
}

std::string protection_of(const std::string& path) {
  struct stat file {};
  if (::stat(path.c_str(), &file) != 0) return {};
  if (std::string reason = write_protection(path, file); !reason.empty()) return "the file " + reason;
  std::error_code unknown;
  const std::string folder = parent_folder(fs::canonical(path, unknown).string());
  if (::access(folder.c_str(), W_OK | X_OK) == 0) return {};
  return "its folder cannot be written: " + std::generic_category().message(errno);
}

namespace {

Descriptor create(const std::string& temporary, const std::string& path) {
  std::optional<Descriptor> file = create_locked(temporary);
  if (!file)
    refuse(path, " is being written by another process; wait for it to end, or choose another output");
  return std::move(*file);
}

void sync(const Descriptor& file, const std::string& path) {
  while (::fsync(file.get()) != 0)
    if (errno != EINTR) throw system_error(ExitCode::io_error, "make durable (fsync)", path, errno);
}

/// Copies mode and owner of the file that is replaced. If the user may not change the owner, it is the user.
void inherit(const Descriptor& file, const std::string& target, const std::string& path) {
  struct stat before {};
  if (::stat(target.c_str(), &before) != 0) return;
  if (::fchown(file.get(), before.st_uid, before.st_gid) != 0 &&
      ::fchown(file.get(), static_cast<uid_t>(-1), before.st_gid) != 0 && errno != EPERM)
    throw system_error(ExitCode::io_error, "keep the owner of", path, errno);
  if (::fchmod(file.get(), before.st_mode & 0777) != 0 && errno != EPERM)
    throw system_error(ExitCode::io_error, "keep the mode of", path, errno);
}

/// Names of temporary files, for a signal handler. One that it has taken is null.
constexpr std::size_t most_listed = 256;
std::array<std::atomic<const char*>, most_listed> unfinished;

/// Returns whether there was room for the name, which must outlive its entry.
bool list(const char* name) {
  for (std::atomic<const char*>& entry : unfinished) {
    const char* none = nullptr;
    if (entry.compare_exchange_strong(none, name)) return true;
  }
  return false;
}

/// Removes a listed name. If a signal handler has taken it, the process is about to end.
void unlist(const char* name) {
  for (std::atomic<const char*>& entry : unfinished) {
    const char* same = name;
    if (entry.compare_exchange_strong(same, nullptr)) return;
  }
  for (;;) ::pause();
}

}  // namespace

void remove_unfinished_files() {
  for (std::atomic<const char*>& entry : unfinished)
    if (const char* const name = entry.exchange(nullptr)) ::unlink(name);
}

OutputFile::OutputFile(const std::string& path)
    : path_(path),
      target_(output_target(path)),
      temporary_path_(target_ + temporary_ending),
      file_(create(temporary_path_, path_)),
      is_listed_(list(temporary_path_.c_str())) {}

OutputFile::~OutputFile() {
  if (is_listed_) unlist(temporary_path_.c_str());
  if (!committed_ && is_named(temporary_path_, file_)) ::unlink(temporary_path_.c_str());
}

void OutputFile::write(std::span<const std::byte> bytes) {
  written_ += bytes.size();
  while (!bytes.empty()) {
    const ssize_t written = ::write(file_.get(), bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) throw system_error(ExitCode::io_error, "write", path_, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void OutputFile::flush() {
  sync(file_, path_);
  struct stat file {};
  if (::fstat(file_.get(), &file) != 0)
    throw system_error(ExitCode::io_error, "read the size of", path_, errno);
  if (const auto size = static_cast<std::uint64_t>(file.st_size); size != written_)
    throw Error(ExitCode::io_error, "{}: has {} bytes on the disk, but {} were written", path_, size,
                written_);
}

void OutputFile::commit() {
  inherit(file_, target_, path_);
  flush();
  if (!is_named(temporary_path_, file_))
    refuse(path_, ": its temporary file " + temporary_path_ +
                      " was removed or replaced while it was written; nothing was changed");
  if (!take_name(temporary_path_, target_, path_)) throw creation_error("create", path_, errno);
  committed_ = true;
  if (std::exchange(is_listed_, false)) unlist(temporary_path_.c_str());
}

namespace {

/// Moves to the beginning of a file in memory and returns its size, bytes.
std::size_t rewind(const Descriptor& file, const std::string& name) {
  const off_t size = ::lseek(file.get(), 0, SEEK_END);
  if (size <= 0) throw Error(ExitCode::io_error, "{}: nothing was written", name);
  ::lseek(file.get(), 0, SEEK_SET);
  return static_cast<std::size_t>(size);
}

void copy(const Descriptor& from, const std::string& name, OutputFile& to) {
  std::vector<std::byte> part(std::size_t{1} << 20);
  while (const std::size_t count = read_at_most(from, part, name)) to.write(std::span(part).first(count));
}

}  // namespace

MemoryFile::MemoryFile(const std::string& name) : name_(name), file_(::memfd_create("talus", MFD_CLOEXEC)) {
  if (file_.get() < 0) throw system_error(ExitCode::io_error, "create a file in memory for", name, errno);
}

std::string MemoryFile::path() const { return fmt::format("/proc/{}/fd/{}", ::getpid(), file_.get()); }

void MemoryFile::copy_to(OutputFile& file) const {
  rewind(file_, name_);
  copy(file_, name_, file);
}

std::vector<std::uint8_t> MemoryFile::bytes() const {
  std::vector<std::uint8_t> bytes(rewind(file_, name_));
  bytes.resize(read_at_most(file_, std::as_writable_bytes(std::span(bytes)), name_));
  return bytes;
}

std::string parent_folder(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

void sync_name(const std::string& path) {
  const Descriptor folder(::open(parent_folder(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.get() < 0) throw system_error(ExitCode::io_error, "open the folder of", path, errno);
  sync(folder, path);
}

void publish_file(const std::string& made, const std::string& path) {
  const std::string target = output_target(path);
  const Descriptor file(::open(made.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC));
  if (file.get() < 0) throw system_error(ExitCode::io_error, "open", made, errno);
  inherit(file, target, path);
  sync(file, path);
  if (take_name(made, target, path)) return;
  if (errno != EXDEV) throw creation_error("create", path, errno);
  OutputFile other(path);
  copy(file, made, other);
  other.commit();
  ::unlink(made.c_str());
}

namespace {

/// Creates a folder and its parents, and makes their names durable.
void make_with_parents(const std::string& folder) {
  if (is_folder(folder)) return;
  if (const std::string parent = parent_folder(folder); parent != folder) make_with_parents(parent);
  if (::mkdir(folder.c_str(), 0777) != 0 && (errno != EEXIST || !is_folder(folder)))
    throw creation_error("create the folder", folder, errno == EEXIST ? ENOTDIR : errno);
  const Descriptor above(::open(parent_folder(folder).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (above.get() >= 0) sync(above, folder);
}

}  // namespace

void prepare_folder(const std::string& folder) {
  make_with_parents(folder);
  clear_leftovers(folder);
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw system_error(ExitCode::cannot_create, "write in the folder", folder, errno);
}

void prepare_folder_of(const std::string& path) {
  const std::string folder = parent_folder(path);
  if (is_folder(folder))
    clear_leftovers(folder);
  else
    prepare_folder(folder);
}

}  // namespace talus
