#include "core/leftovers.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/descriptor.h"
#include "core/locked_file.h"
#include "core/output_file.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code unknown;
  for (fs::directory_iterator entry(folder, unknown), end; !unknown && entry != end; entry.increment(unknown))
    names.push_back(entry->path().filename().string());
  return names;
}

/// NAME of NAME.talus.part; empty where a name is no such one.
std::string name_before_ending(const std::string& name) {
  const bool is_temporary = name.ends_with(temporary_ending);
  return is_temporary ? name.substr(0, name.size() - std::string_view(temporary_ending).size()) : "";
}

/// What is under a name belongs to this user and is a file, or a folder.
bool is_own(const std::string& path, mode_t kind) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 && (status.st_mode & S_IFMT) == kind &&
         status.st_uid == ::geteuid();
}

/// A folder called NAME.talus.part, without a dot in NAME, is that of a figure where all that it holds are
/// files called NAME and something more. Others stay as they are.
void remove_figure_folder(const std::string& path) {
  const std::string name = name_before_ending(fs::path(path).filename().string());
  if (name.find('.') != std::string::npos) return;
  const std::vector<std::string> files = names_in(path);
  const auto is_of_figure = [&](const std::string& file) {
    return file.starts_with(name) && is_own((fs::path(path) / file).string(), S_IFREG);
  };
  if (!std::ranges::all_of(files, is_of_figure)) return;
  for (const std::string& file : files) ::unlink((fs::path(path) / file).c_str());
  ::rmdir(path.c_str());
}

/// While the lock is shared nobody can take a file for writing, and while it is held by its writer it cannot
/// be shared. Who is about to lock a file that it has just made finds the lock shared, waits for it, sees
/// that the name is gone, and makes the file again (create_locked).
void clear(const std::string& path) {
  const bool is_file = is_own(path, S_IFREG);
  if (!is_file && !is_own(path, S_IFDIR)) return;
  const Descriptor left(::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  if (left.get() < 0 || ::flock(left.get(), LOCK_SH | LOCK_NB) != 0 || !is_named(path, left)) return;
  if (is_file)
    ::unlink(path.c_str());
  else
    remove_figure_folder(path);
}

}  // namespace

void clear_leftovers(const std::string& folder) {
  std::vector<std::string> names = names_in(folder);
  std::erase_if(names, [](const std::string& name) { return name_before_ending(name).empty(); });
  if (names.empty()) return;
  // One process at a time: of two that share a lock one could remove what a third has made since.
  const Descriptor place(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (place.get() < 0 || ::flock(place.get(), LOCK_EX | LOCK_NB) != 0) return;
  for (const std::string& name : names) clear((fs::path(folder) / name).string());
}

}  // namespace talus
