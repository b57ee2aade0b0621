#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "base/errors.h"
#include "render/movie.h"
#include "support/temporary_folder.h"

namespace talus::render {
namespace {

/// Returns a frame of one colour that becomes lighter with k.
Image frame(int width, int height, int channels, int k) {
  Image image{width, height, channels, {}};
  for (int pixel = 0; pixel < width * height; ++pixel)
    for (int c = 0; c < channels; ++c) image.pixels.push_back(static_cast<std::uint8_t>(40 * c + 10 * k));
  return image;
}

void make_movie(const std::string& path, int frames, int channels = 1) {
  Movie movie(path, 161, 99, channels, 10.0);
  for (int k = 0; k < frames; ++k) movie.add(frame(161, 99, channels, k));
  movie.finish();
}

std::string output_of(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output.push_back(static_cast<char>(c));
  pclose(pipe);
  return output;
}

/// Sets PATH during its lifetime.
class SearchPath {
 public:
  explicit SearchPath(const std::string& path) : before_(std::getenv("PATH")) {
    setenv("PATH", path.c_str(), 1);
  }
  ~SearchPath() { setenv("PATH", before_.c_str(), 1); }
  SearchPath(const SearchPath&) = delete;
  SearchPath& operator=(const SearchPath&) = delete;

 private:
  std::string before_;
};

/// Writes a program called ffmpeg that executes the shell script.
void write_false_ffmpeg(const std::string& path, const std::string& script) {
  std::ofstream(path) << "#!/bin/sh\n" << script << "\n";
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
}

struct Failure {
  ExitCode code = ExitCode::done;
  std::string message;
};

Failure failure_of_movie(const std::string& path, int frames) {
  try {
    make_movie(path, frames);
  } catch (const Error& error) {
    return {error.code(), error.what()};
  }
  return {};
}

bool have_ffmpeg() {
  return std::system("ffmpeg -version >/dev/null 2>&1") == 0 &&
         std::system("ffprobe -version >/dev/null 2>&1") == 0;
}

TEST(Movie, HasAllFramesInTheirColours) {
  if (!have_ffmpeg()) GTEST_SKIP() << "ffmpeg or ffprobe is not installed";
  const test::TemporaryFolder folder;
  for (int channels : {1, 3})
    for (auto [name, size] :
         {std::pair{"a.mp4", "162,100,12"}, {"a.webm", "161,99,12"}, {"a.gif", "161,99,12"}}) {
      const std::string path = folder.path(name);
      make_movie(path, 12, channels);
      EXPECT_EQ(output_of("ffprobe -v error -count_frames -show_entries stream=width,height,nb_read_frames "
                          "-of csv=p=0 " +
                          path),
                std::string(size) + "\n")
          << name << ", " << channels << " channels";
      const std::string pixel =
          output_of("ffmpeg -v error -i " + path +
                    " -vf 'select=eq(n\\,11),crop=2:2:80:50' -frames:v 1 -f rawvideo -pix_fmt rgb24 -");
      ASSERT_EQ(pixel.size(), 12u) << name;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(static_cast<std::uint8_t>(pixel[static_cast<std::size_t>(c)]),
                    110 + (channels == 3 ? 40 * c : 0), 4)
            << name << ", " << channels << " channels";
    }
}

TEST(Movie, SaysThatFfmpegIsMissing) {
  const test::TemporaryFolder folder;
  const SearchPath nowhere(folder.path("bin"));
  const Failure failure = failure_of_movie(folder.path("a.mp4"), 1);
  EXPECT_EQ(failure.code, ExitCode::unavailable);
  EXPECT_NE(failure.message.find("apt-get install ffmpeg"), std::string::npos) << failure.message;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Movie, ReportsWhatFfmpegSaysAndLeavesNothing) {
  const test::TemporaryFolder folder, tools;
  const SearchPath here(tools.path("") + ":/usr/bin:/bin");
  // One reads everything and fails at its end, and one exits at once while frames are still written.
  for (const char* script :
       {"cat >/dev/null; echo encoder on strike >&2; exit 1", "echo encoder on strike >&2; exit 1"}) {
    write_false_ffmpeg(tools.path("ffmpeg"), script);
    const Failure failure = failure_of_movie(folder.path("a.mp4"), 200);
    EXPECT_EQ(failure.code, ExitCode::io_error);
    EXPECT_NE(failure.message.find("encoder on strike"), std::string::npos) << failure.message;
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  }
}

TEST(Movie, LeavesNothingWhenGivenUp) {
  const test::TemporaryFolder folder, tools;
  const SearchPath here(tools.path("") + ":/usr/bin:/bin");
  write_false_ffmpeg(tools.path("ffmpeg"), "exec cat >/dev/null");
  { Movie movie(folder.path("a.mp4"), 161, 99, 1, 10.0); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Movie, RefusesOtherFormatsAndSizes) {
  const test::TemporaryFolder folder, tools;
  const Failure other = failure_of_movie(folder.path("a.avi"), 1);
  EXPECT_EQ(other.code, ExitCode::usage);
  for (const char* ending : {".mp4", ".webm", ".gif"})
    EXPECT_NE(other.message.find(ending), std::string::npos) << other.message;
  EXPECT_EQ(failure_of_movie(folder.path("missing/a.mp4"), 1).code, ExitCode::cannot_create);
  const SearchPath here(tools.path("") + ":/usr/bin:/bin");
  write_false_ffmpeg(tools.path("ffmpeg"), "exec cat >/dev/null");
  Movie movie(folder.path("a.mp4"), 161, 99, 1, 10.0);
  EXPECT_THROW(movie.add(frame(161, 98, 1, 0)), Error);
  EXPECT_THROW(movie.add(frame(161, 99, 3, 0)), Error);
}

TEST(Movie, IsNotTransparent) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("a.webm");
  try {
    const Movie movie(path, 160, 100, 4, 10.0);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(std::string(error.what()).find("transparent"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace talus::render
