/// Faults in an unmodified program: this library is loaded before its own (LD_PRELOAD) and controlled by its
/// environment.
///     TALUS_FAULT="kill 12"        the process ends in call number 12 of faults.cpp; a write is split
///     TALUS_FAULT="error 5 12"     that call fails with errno 5
///     TALUS_FAULT="lasting 28 12"  that call and all later ones fail with errno 28
///     TALUS_FAULT="no-locks 37"    locking fails with errno 37, in children too
///     TALUS_FAULT="keeps-open"     a file that is removed while open keeps another name until it is closed
///     TALUS_FAULT="memory 12"      allocation number 12 fails
///     TALUS_FAULT="no-memory 12"   that allocation and all later ones fail
///     TALUS_FAULT="clock"          the system clock jumps by days at each reading, and the steady clock by
///                                  an hour at every hundredth
///     TALUS_FAULT_COUNT=FILE       at the end, the numbers of calls and of allocations are written there,
///                                  with the call that failed

#include <fcntl.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "reliability/faults.h"

extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* block, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
}

namespace {

std::atomic<long> allocations{0};
std::atomic<long> failing_allocation{0};  // 0: none
bool all_later_too = false;
bool clock_jumps = false;
std::atomic<long> readings{0};

bool fails() {
  if (!talus::faults::counts_in_process()) return false;
  const long number = ++allocations;
  const long failing = failing_allocation;
  const bool struck = failing > 0 && (number == failing || (all_later_too && number > failing));
  if (struck) errno = ENOMEM;
  return struck;
}

__attribute__((constructor)) void arm_by_environment() {
  using namespace talus::faults;
  const char* text = getenv("TALUS_FAULT");
  if (text == nullptr) text = "";
  char kind[16] = "";
  int first = 0, second = 0;
  const int numbers = std::sscanf(text, "%15s %d %d", kind, &first, &second) - 1;
  Fault fault;
  if (std::strcmp(kind, "kill") == 0) fault = {Kind::kill, first, 0, false};
  if (std::strcmp(kind, "keeps-open") == 0) fault = {Kind::keeps_open};
  if (std::strcmp(kind, "no-locks") == 0) fault = {Kind::no_locks, 0, first};
  if (numbers == 2) fault = {Kind::error, second, first, std::strcmp(kind, "lasting") == 0};
  arm(fault);
  clock_jumps = std::strcmp(kind, "clock") == 0;
  all_later_too = std::strcmp(kind, "no-memory") == 0;
  allocations = 0;
  if (all_later_too || std::strcmp(kind, "memory") == 0) failing_allocation = first;
}

__attribute__((destructor)) void report_counts() {
  const char* path = getenv("TALUS_FAULT_COUNT");
  if (path == nullptr) return;
  char text[320];
  const int size = std::snprintf(text, sizeof text, "%d %ld %s\n", talus::faults::calls(), allocations.load(),
                                 talus::faults::struck());
  const long file = syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  syscall(SYS_write, file, text, size);
  syscall(SYS_close, file);
}

}  // namespace

extern "C" {

// HDF5 reads a packed file in many small calls, which the store itself does not make.
int open64(const char* path, int flags, ...) {
  return talus::faults::strikes_opening(path)
             ? -1
             : static_cast<int>(syscall(SYS_openat, AT_FDCWD, path, flags, 0666));
}
int fcntl(int file, int operation, ...) {
  va_list arguments;
  va_start(arguments, operation);
  void* const argument = va_arg(arguments, void*);  // NOLINT(clang-analyzer-valist.Uninitialized): as above
  va_end(arguments);
  const bool locks =
      operation == F_SETLK || operation == F_SETLKW || operation == F_OFD_SETLK || operation == F_OFD_SETLKW;
  if (locks && talus::faults::has_no_locks()) return -1;
  return static_cast<int>(syscall(SYS_fcntl, file, operation, argument));
}
int fcntl64(int file, int operation, ...) __attribute__((alias("fcntl")));
ssize_t pread64(int file, void* data, size_t size, off_t at) {
  return talus::faults::strikes_reading("read") ? -1 : syscall(SYS_pread64, file, data, size, at);
}

void* malloc(size_t size) noexcept { return fails() ? nullptr : __libc_malloc(size); }
void* calloc(size_t count, size_t size) noexcept { return fails() ? nullptr : __libc_calloc(count, size); }
void* realloc(void* block, size_t size) noexcept { return fails() ? nullptr : __libc_realloc(block, size); }
void* memalign(size_t alignment, size_t size) noexcept {
  return fails() ? nullptr : __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) noexcept { return memalign(alignment, size); }
int posix_memalign(void** block, size_t alignment, size_t size) noexcept {
  *block = memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}

int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const long result = syscall(SYS_clock_gettime, clock, time);
  if (result != 0 || !clock_jumps) return static_cast<int>(result);
  const long reading = ++readings;
  if (clock == CLOCK_REALTIME) time->tv_sec += (reading % 7 - 3) * 86400;
  if (clock == CLOCK_MONOTONIC) time->tv_sec += reading / 100 * 3600;
  return 0;
}
}
