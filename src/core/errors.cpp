#include "core/errors.h"

#include <cstring>

namespace talus {

Error system_error(ExitCode code, const std::string& action, const std::string& path, int errno_value) {
  return Error(code, path + ": cannot " + action + ": " + std::strerror(errno_value));
}

}  // namespace talus
