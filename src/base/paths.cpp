#include "base/paths.h"

#include <filesystem>

#include "base/errors.h"

namespace talus {

namespace fs = std::filesystem;

bool is_there(const std::string& path) {
  std::error_code unknown;
  return fs::exists(path, unknown);
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

}  // namespace talus
