#pragma once
/// How much the work of a thread presses.

namespace talus {

/// From here on the calling thread, and those that it begins, leave the processors to other threads while
/// these have work. For what is done beside a computation that should not wait for it. Nothing else depends
/// on it: where the system refuses, the thread goes on as it was.
void give_way();

}  // namespace talus
