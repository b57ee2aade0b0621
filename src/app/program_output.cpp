#include "app/program_output.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <functional>
#include <memory>

#include "app/stop_signals.h"
#include "base/errors.h"

namespace talus::app {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

File open_temporary() {
  File file(std::tmpfile());
  if (!file) throw system_error(ExitCode::io_error, "open", "a temporary file", errno);
  return file;
}

/// Returns the contents of the file without blank lines at the ends, limited to a length that no useful
/// output exceeds.
std::string text_of(std::FILE* file) {
  constexpr std::size_t limit = std::size_t{1} << 24;
  std::rewind(file);
  std::string all;
  std::array<char, 4096> part{};
  for (std::size_t count = 0;
       all.size() < limit && (count = std::fread(part.data(), 1, part.size(), file)) > 0;)
    all.append(part.data(), count);
  const auto first = all.find_first_not_of(" \n");
  return first == std::string::npos ? "" : all.substr(first, all.find_last_not_of(" \n") + 1 - first);
}

}  // namespace

ProgramOutput output_of(const std::vector<std::string>& words, const std::string& folder,
                        ProgramEnvironment environment, const std::string& advice, bool until_its_end) {
  const File out = open_temporary(), err = open_temporary();
  const ProgramStreams streams = {.out = fileno(out.get()), .err = fileno(err.get())};
  const pid_t program = start_program(words, streams, folder, environment);
  if (program < 0 && errno == ENOENT) throw Error(ExitCode::unavailable, advice);
  if (program < 0) throw system_error(ExitCode::unavailable, "start", words[0], errno);
  const auto watch = until_its_end ? std::function<void()>() : stop_if_asked;
  const int status = wait_for_program(program, watch);
  if (!until_its_end) stop_if_asked();  // Ctrl-C ends the program too, which is not a failure of the program
  return {status, text_of(out.get()), text_of(err.get())};
}

}  // namespace talus::app
