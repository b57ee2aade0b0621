#include "base/errors.h"

#include <cerrno>
#include <cstring>

namespace talus {

Error system_error(ExitCode code, const std::string& action, const std::string& path, int errno_value) {
  return Error(code, "{}: cannot {}: {}", path, action, std::strerror(errno_value));
}

Error creation_error(const std::string& action, const std::string& path, int errno_value) {
  const bool is_disk_error =
      errno_value == ENOSPC || errno_value == EDQUOT || errno_value == EFBIG || errno_value == EIO;
  return system_error(is_disk_error ? ExitCode::io_error : ExitCode::cannot_create, action, path,
                      errno_value);
}

}  // namespace talus
