#pragma once
/// Movies, encoded by ffmpeg from raw frames.

#include <sys/types.h>

#include <string>

#include "base/child_program.h"
#include "base/output_file.h"
#include "render/image.h"

namespace talus::render {

/// A movie being written: H.264 for .mp4, VP9 for .webm, and for .gif 64 grays or, in colour, the best 256
/// colours of each frame. The file appears under its name when finish() returns; an unfinished movie leaves
/// nothing.
class Movie {
 public:
  /// Starts ffmpeg. All frames have the given size and number of channels, 1 or 3, and are shown at `fps`
  /// frames per second. Throws Error(usage) for another extension or for four channels, because movies cannot
  /// be transparent; Error(unavailable) without ffmpeg; Error(cannot_create) if the file cannot be created.
  Movie(const std::string& path, int width, int height, int channels, double fps);
  ~Movie();
  Movie(const Movie&) = delete;
  Movie& operator=(const Movie&) = delete;

  /// Adds a frame. Throws Error(io_error) with ffmpeg's message if ffmpeg failed.
  void add(const Image& image);
  void finish();

 private:
  [[noreturn]] void fail();
  int close_and_wait();

  std::string path_;
  int width_, height_, channels_;
  OutputFile file_;
  MemoryFile made_;
  ProgramText messages_;
  int pipe_ = -1;
  pid_t ffmpeg_ = -1;
};

}  // namespace talus::render
