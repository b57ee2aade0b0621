#include "app/commands.h"

#include <vector>

#include "app/program_help.h"

namespace talus::app {
namespace {

/// A group of commands in the help.
struct CommandGroup {
  const char* title;
  std::vector<void (*)(CLI::App&)> add;
};

}  // namespace

void add_commands(CLI::App& app) {
  const std::vector<CommandGroup> groups = {
      {"Runs",
       {add_run_command, add_check_command, add_info_command, add_replay_command, add_repair_command}},
      {"Pictures",
       {add_view_command, add_render_command, add_panel_command, add_animate_command, add_maps_command}},
      {"Results", {add_analyze_command, add_events_command, add_figures_command, add_export_command}},
      {"Many runs", {add_ensemble_command, add_study_command, add_perturb_command, add_reproduce_command}},
      {"Contact problems", {add_dump_command, add_solve_command, add_forces_command}},
  };
  for (const CommandGroup& group : groups)
    for (void (*const add)(CLI::App&) : group.add) {
      add(app);
      app.get_subcommands([](const CLI::App*) { return true; }).back()->group(group.title);
    }
  add_program_help_command(app);
}

}  // namespace talus::app
