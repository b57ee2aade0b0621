#include "render/movie.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fmt/core.h>
#include <utility>
#include <vector>

#include "base/child_program.h"
#include "base/errors.h"

namespace talus::render {
namespace {

/// Returns the filters and encoder for the extension of the path.
std::vector<std::string> encoder_arguments(const std::string& path, int channels) {
  // The file states its colour matrix; without that, players guess different matrices for small and large
  // pictures.
  const std::string to_yuv = "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p";
  const std::vector<std::string> bt709 = {"-colorspace", "bt709", "-color_primaries", "bt709",
                                          "-color_trc",  "bt709", "-color_range",     "tv"};
  std::vector<std::string> arguments;
  const auto add = [&](const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
  };
  if (path.ends_with(".mp4")) {  // H.264 with subsampled chroma requires even sizes
    add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:0:0:white," + to_yuv, "-c:v", "libx264", "-preset", "veryfast",
         "-crf", "20"});
    add(bt709);
    add({"-movflags", "+faststart", "-f", "mp4"});
  } else if (path.ends_with(
                 ".webm")) {  // "good" quality takes six times as long and reduces the file by only a tenth
    add({"-vf", to_yuv, "-c:v", "libvpx-vp9", "-row-mt", "1", "-deadline", "realtime", "-cpu-used", "6",
         "-crf", "32", "-b:v", "0"});
    add(bt709);
    add({"-f", "webm"});
  } else if (path.ends_with(".gif") && channels == 1) {
    // 64 fixed grays. A palette computed from the frames would be the same, but ffmpeg would hold all frames
    // in memory.
    add({"-vf", "format=gray,lut=c0=round(val*63/255)*255/63", "-pix_fmt", "gray", "-f", "gif"});
  } else if (path.ends_with(".gif")) {
    // One palette per frame; a common palette would also require all frames in memory.
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
    throw Error(ExitCode::usage, path + ": movies cannot be transparent; keep the white background");
  const std::string pixels = channels == 1 ? "gray" : "rgb24", size = fmt::format("{}x{}", width, height),
                    rate = std::to_string(fps);
  std::vector<std::string> arguments = {"ffmpeg",  "-nostdin", "-hide_banner", "-loglevel", "error", "-y",
                                        "-xerror", "-f",       "rawvideo",     "-pix_fmt",  pixels,  "-s",
                                        size,      "-r",       rate,           "-i",        "pipe:0"};
  for (std::string& argument : encoder_arguments(path, channels)) arguments.push_back(std::move(argument));
  // ffmpeg parses "pipe:1.gif" as a protocol and "-x.mp4" as an option, but takes the name after "file:"
  // literally.
  arguments.push_back("file:" + output);
  return arguments;
}

/// Starts ffmpeg with its input at `input` and its messages at `messages`.
pid_t start(const std::vector<std::string>& arguments, int input, int messages) {
  const pid_t program = start_program(arguments, {.in = input, .err = messages});
  if (program < 0 && errno == ENOENT)
    throw Error(ExitCode::unavailable,
                "ffmpeg is not installed, so no movie can be made: apt-get install ffmpeg, or draw single "
                "pictures with talus render");
  if (program < 0) throw system_error(ExitCode::unavailable, "start", "ffmpeg", errno);
  return program;
}

std::string size_text(int width, int height, int channels) {
  return fmt::format("{} x {} px in {} channels", width, height, channels);
}

}  // namespace

Movie::Movie(const std::string& path, int width, int height, int channels, double fps)
    : path_(path),
      width_(width),
      height_(height),
      channels_(channels),
      file_(path),
      made_(path),
      messages_(1024) {
  const std::vector<std::string> arguments =
      ffmpeg_arguments(path, made_.path(), width, height, channels, fps);
  // A socket pair rather than a pipe, because MSG_NOSIGNAL then suppresses SIGPIPE.
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw system_error(ExitCode::io_error, "open a pipe for", path_, errno);
  pipe_ = ends[0];
  try {
    ffmpeg_ = start(arguments, ends[1], messages_.end());
  } catch (...) {
    for (int end : ends) close(end);
    throw;
  }
  close(ends[1]);
  messages_.close_end();
}

Movie::~Movie() {
  if (ffmpeg_ > 0) {
    kill_program(ffmpeg_);
    close_and_wait();
  }
}

void Movie::add(const Image& image) {
  if (image.width != width_ || image.height != height_ || image.channels != channels_)
    throw Error(ExitCode::internal, "a frame of {} does not fit a movie of {}",
                size_text(image.width, image.height, image.channels), size_text(width_, height_, channels_));
  const std::uint8_t* data = image.pixels.data();
  for (std::size_t left = image.pixels.size(); left > 0;) {
    const ssize_t sent = send(pipe_, data, left, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && (errno == EINTR || errno == EAGAIN)) {
      messages_.read();  // a program whose messages are not read stops
      pollfd ready = {pipe_, POLLOUT, 0};
      constexpr int milliseconds = 100;
      poll(&ready, 1, milliseconds);
      continue;
    }
    if (sent < 0) fail();
    data += sent;
    left -= static_cast<std::size_t>(sent);
  }
}

void Movie::finish() {
  if (close_and_wait() != 0) fail();
  made_.copy_to(file_);
  file_.commit();
}

int Movie::close_and_wait() {
  close(pipe_);
  const int status = wait_for_program(std::exchange(ffmpeg_, -1), [this] { messages_.read(); });
  messages_.read();
  return status;
}

void Movie::fail() {
  if (ffmpeg_ > 0) close_and_wait();
  std::string said = messages_.text();
  while (!said.empty() && said.back() == '\n') said.pop_back();
  throw Error(ExitCode::io_error, "{}: ffmpeg gave up{}", path_,
              said.empty() ? "; is the file size limited?" : ": " + said);
}

}  // namespace talus::render
