#include "app/gnuplot.h"

#include <fmt/core.h>
#include <vector>

#include "app/program_output.h"
#include "base/errors.h"

namespace talus::app {
namespace {

/// Runs gnuplot with arguments in a folder, ignoring the user's settings (~/.gnuplot, -d).
ProgramOutput run(const std::string& folder, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {"gnuplot"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return output_of(words, folder, ProgramEnvironment::clean,
                   "gnuplot, which draws the figures, is not installed; apt-get install gnuplot-nox");
}

}  // namespace

void require_gnuplot() { run(".", {"--version"}); }

void run_gnuplot(const std::string& folder, const std::string& script) {
  const ProgramOutput output = run(folder, {"-d", script});
  if (output.status == 0) return;
  const std::string said = output.err.empty() ? output.out : output.err;
  throw Error(ExitCode::io_error, fmt::format("{}: gnuplot failed{}", script,
                                              said.empty() ? "; is the file size limited?" : ": " + said));
}

}  // namespace talus::app
