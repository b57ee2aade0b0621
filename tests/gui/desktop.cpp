#include "gui/desktop.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "render/read_png.h"

namespace talus::test {
namespace {

void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(50)); }
constexpr int longest_pauses = 200;  // ten seconds

/// Starts Xvfb on a free display and returns its name in `display`.
pid_t start_server(std::string& display, bool has_opengl) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], 3);
    const int nothing = open("/dev/null", O_RDWR);
    dup2(nothing, STDOUT_FILENO);
    dup2(nothing, STDERR_FILENO);
    // Without -noreset, Xvfb resets when its only client leaves, and rejects connections meanwhile.
    execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "1500x1000x24", "-nolisten", "tcp", "-noreset",
           has_opengl ? nullptr : "-extension", "GLX", nullptr);
    _exit(127);
  }
  close(ends[1]);
  char digit = 0;
  display.assign(1, ':');
  while (read(ends[0], &digit, 1) == 1 && digit != '\n') display.push_back(digit);
  close(ends[0]);
  return child;
}

void run(const std::string& command) {
  if (std::system(std::string(command).append(" > /dev/null 2>&1").c_str()) != 0)
    throw std::runtime_error("failed: " + command);
}

std::string at(double x, double y) {
  return std::to_string(static_cast<int>(x)).append(" ").append(std::to_string(static_cast<int>(y)));
}

}  // namespace

std::string output_of(const std::string& command) {
  std::FILE* stream = popen(command.c_str(), "r");
  std::string text;
  for (int c = std::fgetc(stream); c != EOF; c = std::fgetc(stream)) text.push_back(static_cast<char>(c));
  pclose(stream);
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

std::string missing_for_desktop() {
  for (const auto& [program, package] :
       {std::pair{"Xvfb", "xvfb"}, {"xdotool", "xdotool"}, {"import", "imagemagick"}})
    if (std::system(std::string("command -v ").append(program).append(" > /dev/null 2>&1").c_str()) != 0)
      return std::string(program).append(" is missing: apt-get install ").append(package);
  return {};
}

Desktop::Desktop(bool has_opengl) {
  std::string display;
  server_ = start_server(display, has_opengl);
  if (display == ":") throw std::runtime_error("Xvfb does not start");
  setenv("DISPLAY", display.c_str(), 1);
}

Desktop::~Desktop() {
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
  unsetenv("DISPLAY");
}

bool Desktop::wait_for_window(const std::string& title) {
  for (int wait = 0; wait < longest_pauses; ++wait, pause()) {
    window_ = output_of("xdotool search --onlyvisible --name '" + title + "' 2> /dev/null | tail -n 1");
    if (!window_.empty()) return true;
  }
  return false;
}

std::string Desktop::title() const { return output_of("xdotool getwindowname " + window_ + " 2> /dev/null"); }

bool Desktop::wait_for_title(const std::string& text, bool contained) const {
  for (int wait = 0; wait < longest_pauses; ++wait, pause())
    if ((title().find(text) != std::string::npos) == contained) return true;
  return false;
}

void Desktop::move(double x, double y) const {
  run("xdotool mousemove --window " + window_ + " " + at(x, y));
}
void Desktop::click() const { run("xdotool click 1"); }

void Desktop::drag(double x, double y) const {
  run("xdotool mousedown 1");
  pause();
  move(x, y);
  pause();
  run("xdotool mouseup 1");
}

void Desktop::key(const std::string& name) const { run("xdotool key " + name); }
void Desktop::resize(int width, int height) const {
  run("xdotool windowsize --sync " + window_ + " " + at(width, height));
}

render::Image Desktop::screenshot(const std::filesystem::path& folder) const {
  const std::string file = (folder / "screen.png").string();
  run("import -window root -depth 8 PNG24:" + file);
  return read_png(file);
}

}  // namespace talus::test
