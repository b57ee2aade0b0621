#include "app/output_files.h"

#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "core/errors.h"

namespace talus {

void refuse_existing(const std::string& path, bool overwrite) {
  if (!overwrite && std::filesystem::exists(path))
    throw Error(ExitCode::cannot_create, path + " exists; give --overwrite to replace it, or another -o");
}

void create_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error(ExitCode::cannot_create, folder + ": cannot create the folder: " + error.message());
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    throw system_error(ExitCode::cannot_create, "write in the folder", folder, errno);
}

}  // namespace talus
