#pragma once
/// The memory available to this process.

namespace talus {

/// Returns the bytes that this process can use: memory and swap of the machine, or the smaller limit of a
/// control group (cgroup) or of the shell (ulimit -v).
double machine_memory();

}  // namespace talus
