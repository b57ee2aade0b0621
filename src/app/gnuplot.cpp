#include "app/gnuplot.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <fmt/core.h>
#include <memory>
#include <vector>

#include "app/stop_signals.h"
#include "core/child_program.h"
#include "core/errors.h"

namespace talus {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Runs gnuplot with arguments in a folder with all that it says in `messages`, and returns its wait status.
/// Settings of the user (~/.gnuplot, -d) do not count. Throws Error(stopped) where a signal asks for it.
int run(const std::string& folder, const std::vector<std::string>& arguments, std::FILE* messages) {
  std::vector<std::string> words = {"gnuplot"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const int to = fileno(messages);
  const pid_t program = start_program(words, {.out = to, .err = to}, folder);
  if (program < 0 && errno == ENOENT)
    throw Error(ExitCode::unavailable,
                "gnuplot is not installed, and figures are drawn by it; apt-get install gnuplot-nox");
  if (program < 0) throw system_error(ExitCode::unavailable, "start", "gnuplot", errno);
  const int status = wait_for_program(program, stop_if_asked);
  stop_if_asked();  // Ctrl-C ends gnuplot too: that is no error of the figure
  return status;
}

File open_messages() {
  File file(std::tmpfile());
  if (!file) throw system_error(ExitCode::io_error, "open", "a temporary file", errno);
  return file;
}

/// What was written to the file, without blank lines at its ends.
std::string text_of(std::FILE* file) {
  std::rewind(file);
  std::array<char, 2048> text{};
  const std::string all(text.data(), std::fread(text.data(), 1, text.size(), file));
  const auto first = all.find_first_not_of(" \n");
  return first == std::string::npos ? "" : all.substr(first, all.find_last_not_of(" \n") + 1 - first);
}

}  // namespace

void require_gnuplot() { run(".", {"--version"}, open_messages().get()); }

void run_gnuplot(const std::string& folder, const std::string& script) {
  const File messages = open_messages();
  if (run(folder, {"-d", script}, messages.get()) == 0) return;
  const std::string said = text_of(messages.get());
  throw Error(ExitCode::io_error,
              fmt::format("{}: gnuplot gave up{}", script, said.empty() ? std::string() : ": " + said));
}

}  // namespace talus
