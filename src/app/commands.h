#pragma once
/// App is the program `talus`. Each function here adds one subcommand to the parser; its callback does the
/// work and throws Error with the exit code of the cause, which main reports (program_end.h). Commands share
/// options (options.h, frame_options.h, map_options.h), print facts as text or JSON (json.h), and start runs
/// (open_run.h) or ensembles (ensemble_workers.h).

#include <CLI/CLI.hpp>

namespace talus::app {

/// Adds --version, all commands in the groups of the help, and the hidden command `program-help`, by which
/// the build makes the man pages.
void add_commands(CLI::App& app);

void add_run_command(CLI::App& app);
void add_check_command(CLI::App& app);
void add_info_command(CLI::App& app);
void add_analyze_command(CLI::App& app);
void add_events_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_maps_command(CLI::App& app);
void add_animate_command(CLI::App& app);
void add_panel_command(CLI::App& app);
void add_export_command(CLI::App& app);
void add_dump_command(CLI::App& app);
void add_solve_command(CLI::App& app);
void add_forces_command(CLI::App& app);
void add_ensemble_command(CLI::App& app);
void add_study_command(CLI::App& app);
void add_perturb_command(CLI::App& app);
void add_figures_command(CLI::App& app);
void add_reproduce_command(CLI::App& app);
void add_view_command(CLI::App& app);
extern const bool has_window;  ///< whether `talus view` is built in
void add_replay_command(CLI::App& app);
void add_repair_command(CLI::App& app);

}  // namespace talus::app
