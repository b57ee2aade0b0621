#include "app/commands.h"

#include <algorithm>
#include <fmt/core.h>
#include <memory>
#include <vector>

#include "app/help_text.h"
#include "base/version.h"
#include "io/run_schema.h"
#include "render/context.h"

namespace talus::app {
namespace {

/// A group of commands in the help.
struct CommandGroup {
  const char* title;
  std::vector<void (*)(CLI::App&)> add;
};

/// Returns version, compiler, optional features, and the versions of the files that it reads and writes.
std::string version_report() {
  const std::string flags = build_flags;
  return fmt::format(
      "{}\n"
      "compiler      {}, {}\n"
      "context       {}\n"
      "window        {}\n"
      "run files     schema version {}\n"
      "analyses      version {}",
      version_text(), compiler, flags.substr(std::min(flags.find_first_not_of(' '), flags.size())),
      render::default_context(),
      has_window ? "built in (talus view)" : "not included: built without GLFW or Dear ImGui",
      io::run_schema_version, io::analysis_version);
}

}  // namespace

void add_commands(CLI::App& app) {
  app.set_version_flag("--version", version_report, "Display program version information and exit");
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
  auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("program-help", "Write a man page of each command");
  command->group("");
  command->add_option("FOLDER", *folder, "Folder of the pages")->required();
  command->callback([folder, &app] { write_man_pages(app, *folder); });
}

}  // namespace talus::app
