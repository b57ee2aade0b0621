#include "core/priority.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

namespace talus {

void give_way() {
  constexpr int nicer = 15, nicest = 19;  // by 15: a thread has 1 part of 30 of a processor that two want
  // On Linux a thread is named like a process, and has a nice value of its own.
  const auto thread = static_cast<id_t>(gettid());
  (void)setpriority(PRIO_PROCESS, thread, std::min(nicest, getpriority(PRIO_PROCESS, thread) + nicer));
}

}  // namespace talus
