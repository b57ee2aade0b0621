#include "app/program_output.h"

#include <cerrno>

#include "app/stop_signals.h"
#include "base/errors.h"

namespace talus::app {
namespace {

/// No useful output is longer.
constexpr std::size_t longest = std::size_t{1} << 24;

/// Returns the text without blank lines at the ends.
std::string stripped(const std::string& all) {
  const auto first = all.find_first_not_of(" \n");
  return first == std::string::npos ? "" : all.substr(first, all.find_last_not_of(" \n") + 1 - first);
}

}  // namespace

ProgramOutput output_of(const std::vector<std::string>& words, const std::string& folder,
                        ProgramEnvironment environment, const std::string& advice, bool until_its_end) {
  ProgramText out(longest), err(longest);
  const pid_t program = start_program(words, {.out = out.end(), .err = err.end()}, folder, environment);
  if (program < 0 && errno == ENOENT) throw Error(ExitCode::unavailable, advice);
  if (program < 0) throw system_error(ExitCode::unavailable, "start", words[0], errno);
  out.close_end();
  err.close_end();
  const auto read = [&] {
    out.read();
    err.read();
    if (!until_its_end) stop_if_asked();
  };
  const int status = wait_for_program(program, read);
  read();  // also ends here after Ctrl-C, which is not a failure of the program
  return {status, stripped(out.text()), stripped(err.text())};
}

}  // namespace talus::app
