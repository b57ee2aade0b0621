#include "support/process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <thread>

#include "base/version.h"
#include "support/places.h"
#include "support/resource_limit.h"

namespace talus::test {
namespace {

/// Appends a line to the file named by the variable TALUS_CALLS, if it is set: commands called, and how they
/// ended (tests/cli/calls_cover).
void note(const std::string& line) {
  const char* path = std::getenv("TALUS_CALLS");
  if (path == nullptr) return;
  const int file = open(path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  const std::string text = line + "\n";
  if (file < 0 || write(file, text.data(), text.size()) < 0) std::perror(path);
  close(file);
}

pid_t start(const Words& arguments, const std::filesystem::path& folder, const Words& environment,
            const std::string& out, const std::string& err) {
  const pid_t child = fork();
  if (child != 0) return child;
  if (chdir(folder.c_str()) != 0) _exit(126);
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  for (const std::string& variable : environment) putenv(const_cast<char*>(variable.c_str()));
  dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
  dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
  std::vector<char*> argv;
  std::string program = talus_program();
  argv.push_back(program.data());
  Words copies = arguments;
  for (std::string& argument : copies) argv.push_back(argument.data());
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  _exit(127);
}

}  // namespace

bool has_python_package() {
  const std::filesystem::path package = std::filesystem::path(talus_program()).parent_path() / "python";
  return !sanitizes_addresses && !sanitizes_threads && std::filesystem::exists(package / "talus/start.py");
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

Outcome run_talus(const Words& arguments, const std::filesystem::path& folder, const Words& environment) {
  const std::string out = (folder / ".stdout").string();
  const std::string err = (folder / ".stderr").string();
  Outcome outcome;
  outcome.exit_code = wait_for(start(arguments, folder, environment, out, err));
  outcome.out = text_of(out);
  const bool is_help = std::ranges::find(arguments, "--help") != arguments.end();
  if (outcome.exit_code == 0 && !arguments.empty() && !is_help) note("command " + arguments.front());
  outcome.err = text_of(err);
  return outcome;
}

pid_t start_talus(const Words& arguments, const std::filesystem::path& folder) {
  return start(arguments, folder, {}, "/dev/null", (folder / ".stderr").string());
}

std::string errors_in(const std::filesystem::path& folder) { return text_of((folder / ".stderr").string()); }

int wait_for(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  note("code " + std::to_string(code));
  return code;
}

bool has_ended(pid_t process) {
  siginfo_t info = {};
  return waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
         info.si_pid == process;
}

bool wait_until_caught(pid_t process, int signal) {
  const std::string status = "/proc/" + std::to_string(process) + "/status", mark = "SigCgt:";
  for (int wait = 0; wait < 6000 && !has_ended(process); ++wait) {
    const std::string text = text_of(status);
    const std::size_t at = text.find(mark);
    const std::uint64_t caught =
        at == std::string::npos ? 0 : std::strtoull(text.c_str() + at + mark.size(), nullptr, 16);
    if ((caught >> (signal - 1) & 1) != 0) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

void pause_before(int attempt, double milliseconds) {
  std::this_thread::sleep_for(
      std::chrono::duration<double, std::milli>(milliseconds * std::pow(1.25, attempt)));
}

std::vector<int> stop_until_done(const std::function<pid_t()>& start, int signal, double milliseconds,
                                 const std::filesystem::path& result) {
  std::vector<int> codes;
  for (int attempt = 0; attempt < 40 && (codes.empty() || codes.back() != 0); ++attempt) {
    const pid_t process = start();
    pause_before(attempt, milliseconds);
    kill(process, signal);
    codes.push_back(wait_for(process));
    if (codes.size() > 1 || codes.back() != 0) continue;
    codes.clear();
    std::filesystem::remove_all(result);
  }
  return codes;
}

std::string write_file(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  std::ofstream(folder.path(name)) << text;
  return name;
}

std::vector<Words> talus_commands(const std::string& page, const Words& names) {
  std::ifstream file(source_folder() + "/" + page);
  std::vector<Words> found;
  for (std::string line; std::getline(file, line);) {
    std::istringstream text(line.substr(0, line.find('#')));
    std::string program;
    text >> program;
    const Words words{std::istream_iterator<std::string>(text), {}};
    const bool is_talus = program == "talus" || program.ends_with("/talus");
    if (is_talus && !words.empty() && std::ranges::find(names, words[0]) != names.end())
      found.push_back(words);
  }
  return found;
}

std::string json_value(const std::string& json, const std::string& key) {
  const std::string mark = "\"" + key + "\":";
  const std::size_t at = json.find(mark);
  if (at == std::string::npos) return {};
  std::size_t begin = json.find_first_not_of(' ', at + mark.size());
  const bool quoted = json[begin] == '"';
  if (quoted) ++begin;
  return json.substr(begin, json.find_first_of(quoted ? "\"" : ",}\n", begin) - begin);
}

}  // namespace talus::test
