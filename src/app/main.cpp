/// The command line: parses, runs one subcommand, and turns errors into messages and exit codes.

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/help_text.h"
#include "app/program_end.h"
#include "app/run_files.h"
#include "app/terminal.h"
#include "base/errors.h"

namespace {

/// Rejects empty values of options and arguments, such as `-o "$NAME"` with an unset variable, which some
/// options would treat as not given. No other function checks this.
void refuse_empty_words(CLI::App& app) {
  const auto refuse = [](const std::string& word) {
    return word.empty() ? std::string("expected a value, found an empty one") : std::string();
  };
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    for (CLI::Option* option : command->get_options()) option->check(refuse);
    refuse_empty_words(*command);
  }
}

/// Returns the arguments, with `talus help COMMAND` as `talus COMMAND --help`.
std::vector<std::string> words_of(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(1, argc), argv + argc);
  if (words.empty() || words[0] != "help") return words;
  words.erase(words.begin());
  words.emplace_back("--help");
  return words;
}

void run(std::vector<std::string> words, CLI::App& app) {
  app.require_subcommand(1);
  app.formatter(std::make_shared<talus::app::HelpText>());
  talus::app::add_commands(app);
  talus::app::add_examples(app);
  app.footer(
      "Exit codes: 0 done, 64 usage, 65 bad scenario, run or problem, 66 missing input,\n69 no context, "
      "display or tool, 70 internal, 71 out of memory, 73 cannot create output,\n74 I/O error, 75 stopped "
      "and resumable.");
  if (!words.empty() && words[0] == "complete-words")  // by completions of shells (assets/completions)
    return talus::app::print_text(talus::app::completions(app, {words.begin() + 1, words.end()}));
  refuse_empty_words(app);
  talus::app::check_arguments(app, words);
  std::ranges::reverse(words);  // the order that the parser expects
  app.parse(std::move(words));
}

/// Throws if standard output could not be written, because a full disk must not silently truncate results.
void require_printed() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw talus::system_error(talus::ExitCode::io_error, "write", "standard output", errno);
}

/// Runs the command line; converts parse errors to Error, and passes other exceptions on.
int run_command_line(int argc, char** argv) {
  CLI::App app{
      "Granular slopes by Contact Dynamics, from a scenario file to maps of failure.\n\nFirst steps, in the "
      "folder that contains assets/scenarios (in an installation\nshare/talus/scenarios):\n  talus run "
      "assets/scenarios/demo.toml -o demo.h5\n  talus render demo.h5 --at 0,10,repose\n  talus view "
      "demo.h5\n",
      "talus"};
  try {
    run(words_of(argc, argv), app);
  } catch (const CLI::RuntimeError& error) {  // of a Python module, which has printed its message
    return error.get_exit_code();
  } catch (const CLI::ParseError& error) {  // includes --help and --version, which are no errors
    if (error.get_exit_code() != 0)
      throw talus::Error(talus::ExitCode::usage, talus::app::usage_message(app, error));
    app.exit(error);
  }
  require_printed();
  talus::app::note_missing_locks();
  errno = 0;  // earlier failed calls did not matter
  return static_cast<int>(talus::ExitCode::done);
}

}  // namespace

int main(int argc, char** argv) {
  talus::app::end_on_signals();
  // If the parent ignored SIGCHLD, the exit status of children would be lost.
  std::signal(SIGCHLD, SIG_DFL);
  std::signal(SIGXFSZ, SIG_IGN);  // a file size limit is an error of the write, not the end of the process
  try {
    return run_command_line(argc, argv);
  } catch (...) {
    const int code = talus::app::report_exception();
    errno = 0;  // already reported
    return code;
  }
}
