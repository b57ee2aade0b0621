#pragma once
/// Movies, through a pipe of raw frames to ffmpeg.

#include <sys/types.h>

#include <cstdio>
#include <string>

#include "base/output_file.h"
#include "render/image.h"

namespace talus::render {

/// A movie being written: H.264 in a file that ends in .mp4, VP9 in .webm; in .gif 64 grays, or the 256 best
/// colours of each frame in colour. The file appears under its name when finish returns; a movie that is not
/// finished leaves nothing.
class Movie {
 public:
  /// All frames have the size and number of channels given, 1 or 3; `fps` frames a second are shown.
  /// Throws Error(usage) at another ending or at four channels, for movies are not transparent;
  /// Error(unavailable) without ffmpeg; Error(cannot_create) if the file cannot be created.
  Movie(const std::string& path, int width, int height, int channels, double fps);
  ~Movie();
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;

  /// Throws Error(io_error) with the message of ffmpeg if it gave up.
  void add(const Image& image);
  void finish();

 private:
  [[noreturn]] void fail();
  int close_and_wait();

  std::string path_;
  int width_, height_, channels_;
  OutputFile file_;
  MemoryFile made_;
  std::FILE* messages_ = nullptr;
  int pipe_ = -1;
  pid_t ffmpeg_ = -1;
};

}  // namespace talus::render
