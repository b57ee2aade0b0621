#pragma once
/// Limits of this process, for tests of what happens beyond them.

#include <sys/resource.h>

namespace talus::test {

#if defined(__SANITIZE_THREAD__)
inline constexpr bool sanitizes_threads = true;
#else
inline constexpr bool sanitizes_threads = false;
#endif

/// Limits a resource, such as RLIMIT_FSIZE or RLIMIT_AS, of this process and its children during its
/// lifetime.
class ResourceLimit {
 public:
  ResourceLimit(int resource, rlim_t bytes) : resource_(static_cast<__rlimit_resource>(resource)) {
    getrlimit(resource_, &before_);
    const rlimit less = {bytes, before_.rlim_max};
    setrlimit(resource_, &less);
  }
  ~ResourceLimit() { setrlimit(resource_, &before_); }
  ResourceLimit(const ResourceLimit&) = delete;
  ResourceLimit& operator=(const ResourceLimit&) = delete;

 private:
  __rlimit_resource resource_;
  rlimit before_{};
};

}  // namespace talus::test
