/// Processes that AddressSanitizer of clang before 18 can fork while they have threads. A child inherits the
/// locks of the sanitizer's allocator and waits for ever for a lock that another thread held (seen once in
/// 300 forks while another thread allocated). Later versions handle this themselves.

#include <pthread.h>

namespace __lsan {
void LockThreadRegistry();
void UnlockThreadRegistry();
void LockAllocator();
void UnlockAllocator();
}  // namespace __lsan

namespace __sanitizer {
void StackDepotLockAll();
void StackDepotUnlockAll();
}  // namespace __sanitizer

namespace {

void lock() {
  __lsan::LockThreadRegistry();
  __lsan::LockAllocator();
  __sanitizer::StackDepotLockAll();
}

void unlock() {
  __sanitizer::StackDepotUnlockAll();
  __lsan::UnlockAllocator();
  __lsan::UnlockThreadRegistry();
}

[[maybe_unused]] const int installed = pthread_atfork(lock, unlock, unlock);

}  // namespace
