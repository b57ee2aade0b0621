#include "render/movie.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <vector>

#include "core/errors.h"

extern char** environ;

namespace talus {
namespace {

std::vector<std::string> ffmpeg_arguments(const std::string& path, const std::string& output, int width,
                                          int height, double fps) {
  std::vector<std::string> arguments = {"ffmpeg",       "-nostdin",
                                        "-hide_banner", "-loglevel",
                                        "error",        "-y",
                                        "-f",           "rawvideo",
                                        "-pix_fmt",     "gray",
                                        "-s",           std::to_string(width) + "x" + std::to_string(height),
                                        "-r",           std::to_string(fps),
                                        "-i",           "pipe:0"};
  const auto add = [&](std::initializer_list<const char*> more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
  };
  if (path.ends_with(".mp4"))  // H.264 with shared chroma takes even sizes only
    add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:0:0:white,format=yuv420p", "-c:v", "libx264", "-preset",
         "veryfast", "-crf", "20", "-movflags", "+faststart", "-f", "mp4"});
  else if (path.ends_with(".gif"))
    // 64 fixed grays. A palette made from the frames would be the same one, after holding all of them in
    // memory.
    add({"-vf", "format=gray,lut=c0=round(val*63/255)*255/63", "-pix_fmt", "gray", "-f", "gif"});
  else
    throw Error(ExitCode::usage, path + ": expected a name that ends in .mp4 or .gif");
  arguments.push_back(output);
  return arguments;
}

/// Starts ffmpeg with its input at `input` and its messages at `messages`.
pid_t start(const std::vector<std::string>& arguments, int input, int messages) {
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, messages, STDERR_FILENO);
  pid_t child = -1;
  const int error = posix_spawnp(&child, pointers[0], &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT)
    throw Error(ExitCode::unavailable,
                "ffmpeg is not installed, and movies are made by it; apt-get install ffmpeg, or "
                "make single pictures with talus render");
  if (error != 0) throw system_error(ExitCode::unavailable, "start", "ffmpeg", error);
  return child;
}

}  // namespace

Movie::Movie(const std::string& path, int width, int height, double fps)
    : path_(path), width_(width), height_(height), file_(path) {
  const std::vector<std::string> arguments =
      ffmpeg_arguments(path, file_.temporary_path(), width, height, fps);
  // A socket pair instead of a pipe: writing to it can be told not to raise SIGPIPE.
  std::array<int, 2> ends{};
  messages_ = std::tmpfile();
  if (!messages_ || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    const int error = errno;
    if (messages_) std::fclose(messages_);
    throw system_error(ExitCode::io_error, "open a pipe for", path_, error);
  }
  pipe_ = ends[0];
  try {
    ffmpeg_ = start(arguments, ends[1], fileno(messages_));
  } catch (...) {
    for (int end : ends) close(end);
    std::fclose(messages_);
    throw;
  }
  close(ends[1]);
}

Movie::~Movie() {
  if (ffmpeg_ > 0) {
    kill(ffmpeg_, SIGKILL);
    close_and_wait();
  }
  std::fclose(messages_);
}

void Movie::add(const Image& image) {
  if (image.width != width_ || image.height != height_)
    throw Error(ExitCode::internal, "a frame of " + std::to_string(image.width) + " x " +
                                        std::to_string(image.height) + " px does not fit a movie of " +
                                        std::to_string(width_) + " x " + std::to_string(height_) + " px");
  const std::uint8_t* data = image.gray.data();
  for (std::size_t left = image.gray.size(); left > 0;) {
    const ssize_t sent = send(pipe_, data, left, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) fail();
    data += sent;
    left -= static_cast<std::size_t>(sent);
  }
}

void Movie::finish() {
  if (close_and_wait() != 0) fail();
  file_.commit();
}

int Movie::close_and_wait() {
  close(pipe_);
  int status = 0;
  while (waitpid(ffmpeg_, &status, 0) < 0 && errno == EINTR) {
  }
  ffmpeg_ = -1;
  return status;
}

void Movie::fail() {
  if (ffmpeg_ > 0) close_and_wait();
  std::rewind(messages_);
  std::array<char, 1024> text{};
  const std::size_t size = std::fread(text.data(), 1, text.size(), messages_);
  std::string said(text.data(), size);
  while (!said.empty() && said.back() == '\n') said.pop_back();
  throw Error(ExitCode::io_error, path_ + ": ffmpeg gave up" + (said.empty() ? "" : ": " + said));
}

}  // namespace talus
