#include "base/machine_memory.h"

#include <sys/resource.h>
#include <sys/sysinfo.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr double unlimited = std::numeric_limits<double>::infinity();

double physical_memory() {
  struct sysinfo info = {};
  if (sysinfo(&info) != 0) return unlimited;
  return (static_cast<double>(info.totalram) + static_cast<double>(info.totalswap)) * info.mem_unit;
}

double shell_limit() {
  rlimit limit = {};
  const bool limited = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return limited ? static_cast<double>(limit.rlim_cur) : unlimited;
}

/// Returns the smallest limit of a group and its parents. A file without a number ("max") is no limit.
double min_limit(const fs::path& root, fs::path group, const char* file) {
  double least = unlimited;
  for (;; group = group.parent_path()) {
    double limit = 0.0;
    if (std::ifstream(root / group.relative_path() / file) >> limit) least = std::min(least, limit);
    if (!group.has_relative_path()) return least;
  }
}

/// Returns the limit of the control groups, from lines "0::/group" (version 2) and "5:memory:/group"
/// (version 1).
double cgroup_memory() {
  double least = unlimited;
  std::ifstream groups("/proc/self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string kinds = line.substr(first + 1, second - first - 1), group = line.substr(second + 1);
    if (kinds.empty()) least = std::min(least, min_limit("/sys/fs/cgroup", group, "memory.max"));
    if (kinds == "memory")
      least = std::min(least, min_limit("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
  }
  return least;
}

}  // namespace

double machine_memory() { return std::min({physical_memory(), shell_limit(), cgroup_memory()}); }

}  // namespace talus
