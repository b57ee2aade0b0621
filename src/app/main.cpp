/// The command line: parses, runs one subcommand, and turns errors into messages and exit codes.

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string>

#include "app/commands.h"
#include "app/program_end.h"
#include "app/program_help.h"
#include "app/stop_signals.h"
#include "core/errors.h"
#include "core/visible_text.h"
#include "scenario/suggestion.h"

namespace {

/// A first word that is no command.
void refuse_unknown_command(const CLI::App& app, const std::string& word) {
  std::string nearest;
  std::size_t least = std::string::npos;
  if (word.starts_with('-')) return;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    const std::size_t distance = talus::edit_distance(word.substr(0, 60), command->get_name());
    if (distance < least) nearest = command->get_name();
    least = std::min(least, distance);
  }
  if (least == 0) return;
  const std::string advice = least <= 2 ? "did you mean '" + nearest + "'? " : "";
  throw talus::Error(talus::ExitCode::usage, "'" + talus::visible_word(word) + "' is no command; " + advice +
                                                 "talus --help lists them");
}

/// No option or argument means anything where it is empty, as `-o "$NAME"` is without the variable; some
/// would take it for an option that was not given. The only place that looks.
void refuse_empty_words(CLI::App& app) {
  const auto refuse = [](const std::string& word) {
    return word.empty() ? std::string("expected a value, found an empty one") : std::string();
  };
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    for (CLI::Option* option : command->get_options()) option->check(refuse);
    refuse_empty_words(*command);
  }
}

void run(int argc, char** argv, CLI::App& app) {
  app.set_version_flag("--version", talus::version_report());
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 64 usage, 65 bad scenario, run or problem, 66 missing input,\n"
      "69 no context, display or tool, 70 internal, 71 out of memory, 73 cannot create output,\n"
      "74 I/O error, 75 stopped and resumable.");
  talus::add_run_command(app);
  talus::add_check_command(app);
  talus::add_info_command(app);
  talus::add_analyze_command(app);
  talus::add_render_command(app);
  talus::add_animate_command(app);
  talus::add_panel_command(app);
  talus::add_export_command(app);
  talus::add_dump_command(app);
  talus::add_solve_command(app);
  talus::add_forces_command(app);
  talus::add_ensemble_command(app);
  talus::add_study_command(app);
  talus::add_perturb_command(app);
  talus::add_figures_command(app);
  talus::add_reproduce_command(app);
  talus::add_view_command(app);
  talus::add_replay_command(app);
  talus::add_repair_command(app);
  talus::add_program_help_command(app);
  refuse_empty_words(app);
  if (argc > 1) refuse_unknown_command(app, argv[1]);
  app.parse(argc, argv);
}

/// What a command has printed is part of its result: a full disk must not cut it off unseen.
void require_printed() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw talus::system_error(talus::ExitCode::io_error, "write", "standard output", errno);
}

/// Runs the command line; tells parse errors, and passes on the others.
int run_and_tell(int argc, char** argv) {
  CLI::App app{"Talus: granular slopes by Contact Dynamics, from a scenario file to maps of failure.",
               "talus"};
  int code = static_cast<int>(talus::ExitCode::done);
  try {
    run(argc, argv, app);
  } catch (const CLI::ParseError& error) {  // --help and --version among them, which are no errors
    if (app.exit(error) != 0) code = static_cast<int>(talus::ExitCode::usage);
  }
  require_printed();
  errno = 0;  // whatever could not be had was not needed
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  talus::end_on_signals();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of its write, not the end
  try {
    return run_and_tell(argc, argv);
  } catch (...) {
    const int code = talus::report_exception();
    errno = 0;  // it is told
    return code;
  }
}
