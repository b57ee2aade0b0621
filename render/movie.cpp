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

/// Filters and encoder by the ending of the path.
std::vector<std::string> encoder_arguments(const std::string& path, int channels) {
  // Colours by one matrix that the file names, or players would guess another for small pictures than for
  // large.
  const std::string to_yuv = "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p";
  const std::vector<std::string> bt709 = {"-colorspace", "bt709", "-color_primaries", "bt709",
                                          "-color_trc",  "bt709", "-color_range",     "tv"};
  std::vector<std::string> arguments;
  const auto add = [&](const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
  };
  if (path.ends_with(".mp4")) {  // H.264 with shared chroma takes even sizes only
    add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:0:0:white," + to_yuv, "-c:v", "libx264", "-preset", "veryfast",
         "-crf", "20"});
    add(bt709);
    add({"-movflags", "+faststart", "-f", "mp4"});
  } else if (path.ends_with(
                 ".webm")) {  // "good" quality takes six times as long, for a file smaller by a tenth
    add({"-vf", to_yuv, "-c:v", "libvpx-vp9", "-row-mt", "1", "-deadline", "realtime", "-cpu-used", "6",
         "-crf", "32", "-b:v", "0"});
    add(bt709);
    add({"-f", "webm"});
  } else if (path.ends_with(".gif") && channels == 1) {
    // 64 fixed grays. A palette made from the frames would be the same one, after holding all of them in
    // memory.
    add({"-vf", "format=gray,lut=c0=round(val*63/255)*255/63", "-pix_fmt", "gray", "-f", "gif"});
  } else if (path.ends_with(".gif")) {
    // A palette for each frame: one for all of them would hold all in memory as well.
    add({"-vf", "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=dither=none:new=1", "-f",
         "gif"});
  } else {
    throw Error(ExitCode::usage, path + ": expected a name that ends in .mp4, .webm or .gif");
  }
  return arguments;
}

std::vector<std::string> ffmpeg_arguments(const std::string& path, const std::string& output, int width,
                                          int height, int channels, double fps) {
  if (channels != 1 && channels != 3)
    throw Error(ExitCode::usage, path + ": movies are not transparent; leave the background white");
  std::vector<std::string> arguments = {"ffmpeg",       "-nostdin",
                                        "-hide_banner", "-loglevel",
                                        "error",        "-y",
                                        "-f",           "rawvideo",
                                        "-pix_fmt",     channels == 1 ? "gray" : "rgb24",
                                        "-s",           std::to_string(width) + "x" + std::to_string(height),
                                        "-r",           std::to_string(fps),
                                        "-i",           "pipe:0"};
  for (std::string& argument : encoder_arguments(path, channels)) arguments.push_back(std::move(argument));
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

std::string size_text(int width, int height, int channels) {
  return std::to_string(width) + " x " + std::to_string(height) + " px in " + std::to_string(channels) +
         " channels";
}

}  // namespace

Movie::Movie(const std::string& path, int width, int height, int channels, double fps)
    : path_(path), width_(width), height_(height), channels_(channels), file_(path) {
  const std::vector<std::string> arguments =
      ffmpeg_arguments(path, file_.temporary_path(), width, height, channels, fps);
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
  if (image.width != width_ || image.height != height_ || image.channels != channels_)
    throw Error(ExitCode::internal, "a frame of " + size_text(image.width, image.height, image.channels) +
                                        " does not fit a movie of " + size_text(width_, height_, channels_));
  const std::uint8_t* data = image.pixels.data();
  for (std::size_t left = image.pixels.size(); left > 0;) {
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
