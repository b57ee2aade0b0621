#include "app/program_help.h"

#include <algorithm>
#include <filesystem>
#include <fmt/core.h>
#include <memory>

#include "app/commands.h"
#include "app/completions.h"
#include "app/man_pages.h"
#include "base/output_file.h"
#include "base/version.h"
#include "io/analysis_schema.h"
#include "io/durable_file.h"
#include "io/run_schema.h"
#include "render/context.h"

namespace talus::app {
namespace {

/// Writes a file below the folder, which corresponds to /usr/share.
void write_below(const std::string& folder, const std::string& name, const std::string& text) {
  const std::string path = (std::filesystem::path(folder) / name).string();
  prepare_folder_of(path);
  io::write_text(path, text);
}

}  // namespace

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

void add_program_help_command(CLI::App& app) {
  auto folder = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("program-help", "Write man pages and completions for bash, zsh and fish");
  command->group("");
  command->add_option("FOLDER", *folder, "Folder to write, in place of /usr/share")->required();
  command->callback([folder, &app] {
    const CommandPage program = command_tree(app, app.get_name());
    for (const auto& [name, text] : man_pages(program)) write_below(*folder, "man/man1/" + name, text);
    write_below(*folder, "bash-completion/completions/talus", bash_completion(program));
    // Debian's zsh searches the first below /usr, and the second below /usr/local.
    for (const char* place : {"zsh/vendor-completions/_talus", "zsh/site-functions/_talus"})
      write_below(*folder, place, zsh_completion(program));
    write_below(*folder, "fish/vendor_completions.d/talus.fish", fish_completion(program));
  });
}

}  // namespace talus::app
