#pragma once
/// `talus ensemble submit` and related commands: workers as a Slurm job array.

#include <CLI/CLI.hpp>

namespace talus::app {

/// Adds submit, cancel and requeue to `talus ensemble`; requeue is called by the script of a task.
void add_submit_commands(CLI::App& ensemble);

}  // namespace talus::app
