#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "core/errors.h"
#include "render/png.h"
#include "render/read_png.h"
#include "support/temporary_folder.h"

namespace talus {
namespace {

Image gradient(int width, int height) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.gray.push_back(static_cast<std::uint8_t>(x * 7 + y * y));
  return image;
}

ExitCode code_of_writing(const std::string& path, const Image& image) {
  try {
    write_png(path, image);
  } catch (const Error& error) {
    return error.code();
  }
  return ExitCode::done;
}

TEST(Png, ReadsBackAsItWas) {
  const test::TemporaryFolder folder;
  const Image image = gradient(301, 77);
  write_png(folder.path("a.png"), image);
  const Image back = test::read_png(folder.path("a.png"));
  EXPECT_EQ(back.width, image.width);
  EXPECT_EQ(back.height, image.height);
  EXPECT_EQ(back.gray, image.gray);
}

TEST(Png, SaysWhereItCannotBeCreated) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(code_of_writing(folder.path("missing/a.png"), gradient(9, 9)), ExitCode::cannot_create);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

/// Files of this process may not grow beyond a size while it lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
};

TEST(Png, LeavesNothingWhereWritingFails) {
  const test::TemporaryFolder folder;
  {
    const FileSizeLimit limit(1000);
    EXPECT_EQ(code_of_writing(folder.path("a.png"), gradient(300, 300)), ExitCode::io_error);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Png, KeepsTheOldFileWhereWritingFails) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("a.png");
  write_png(path, gradient(20, 20));
  {
    const FileSizeLimit limit(1000);
    EXPECT_EQ(code_of_writing(path, gradient(300, 300)), ExitCode::io_error);
  }
  EXPECT_EQ(test::read_png(path).width, 20);
}

}  // namespace
}  // namespace talus
