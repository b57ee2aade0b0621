#pragma once
/// `talus ensemble submit` and what belongs to it: workers as a job array of Slurm.

#include <CLI/CLI.hpp>

namespace talus::app {

/// Adds submit, cancel, and requeue, which the script of a task calls, to `talus ensemble`.
void add_submit_commands(CLI::App& ensemble);

}  // namespace talus::app
