#pragma once
/// How much memory there is.

namespace talus {

/// Bytes that this process can have: memory and swap of the machine, or less where a control group (cgroup)
/// or a limit of the shell (ulimit -v) allows less.
double machine_memory();

}  // namespace talus
