#pragma once
/// Several runs side by side, each a process of this program.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace talus {

struct ChildRun {
  std::vector<std::string> arguments;  ///< of this program, from the subcommand on
  std::string log;                     ///< file to which all it prints is appended
};

/// What the caller is told; each may be empty. `child` is an index into the list of children.
struct ChildEvents {
  std::function<void(std::size_t child)> on_start;
  std::function<void(std::size_t child, int exit_code)> on_end;  ///< 128 + signal where a signal ended it
  std::function<void()> on_wait;                                 ///< about twice a second
};

/// Runs all children in their order, `at_once` at a time. SIGINT and SIGTERM are passed to them as SIGTERM,
/// and no more are started. Returns false where that happened. Children do not outlive this process: where it
/// is killed they get SIGTERM. Throws Error(io_error) where no process can be made.
bool run_children(const std::vector<ChildRun>& children, int at_once, const ChildEvents& events);

}  // namespace talus
