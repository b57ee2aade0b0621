#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdio>
#include <filesystem>

#include "base/errors.h"
#include "render/png.h"
#include "render/read_png.h"
#include "support/exit_code.h"
#include "support/temporary_folder.h"

namespace talus::render {
namespace {

/// Returns a picture with runs of equal pixels, and pixels that all differ.
Image pattern(int width, int height, int channels = 1) {
  Image image{width, height, channels, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < channels; ++c)
        image.pixels.push_back(static_cast<std::uint8_t>(y % 3 == 0 ? 40 * c : x * (7 + c) + y * y));
  return image;
}

ExitCode code_of_writing(const std::string& path, const Image& image, const PictureTexts& texts = {}) {
  return test::exit_code_of([&] { write_png(path, image, texts); });
}

TEST(Png, ReadsBackAsItWas) {
  const test::TemporaryFolder folder;
  for (int channels : {1, 3, 4})
    for (auto [width, height] : {std::pair{301, 77}, {1, 1}, {1, 40}, {5000, 3}}) {
      const Image image = pattern(width, height, channels);
      write_png(folder.path("a.png"), image, {{"Key", "a text"}});
      const Image back = test::read_png(folder.path("a.png"));
      EXPECT_EQ(back.width, image.width);
      EXPECT_EQ(back.height, image.height);
      EXPECT_EQ(back.channels, channels);
      EXPECT_EQ(back.pixels, image.pixels) << width << " x " << height << ", " << channels << " channels";
    }
}

TEST(Png, KeepsTexts) {
  const std::vector<std::uint8_t> png =
      encode_png(pattern(30, 20), {{"Key", "first"}, {"Keyword", "a=1 b=[2]"}});
  const std::string bytes(png.begin(), png.end());
  EXPECT_NE(bytes.find(std::string("tEXtKey\0first", 13)), std::string::npos);
  EXPECT_NE(bytes.find(std::string("tEXtKeyword\0a=1 b=[2]", 21)), std::string::npos);
}

TEST(Png, SaysHowWideItIsPrinted) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("a.png");
  write_png(path, pattern(1016, 20), {{"Key", "text"}}, 0.086);
  EXPECT_EQ(test::read_png(path).pixels, pattern(1016, 20).pixels);
  const std::vector<std::uint8_t> plain = encode_png(pattern(1016, 20)),
                                  printed = encode_png(pattern(1016, 20), {}, 0.086);
  const std::string bytes(printed.begin(), printed.end());
  const std::string wanted = std::string("pHYs\0\0\x2E\x26\0\0\x2E\x26\1", 13);  // 11814 per metre
  EXPECT_NE(bytes.find(wanted), std::string::npos);
  EXPECT_EQ(printed.size(), plain.size() + 21);
  std::vector<std::uint8_t> none = {1, 2, 3};
  print_at(none, 0.1);
  EXPECT_EQ(none.size(), 3u);
}

TEST(Png, RefusesWhatItCannotHold) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("a.png");
  Image two = pattern(4, 4, 2), cut = pattern(4, 4);
  cut.pixels.pop_back();
  for (const Image& image : {two, cut, Image{}}) EXPECT_EQ(code_of_writing(path, image), ExitCode::internal);
  const std::string long_key(80, 'k');
  for (const auto& [key, text] : PictureTexts{{"", "a"}, {long_key, "a"}, {"k\n", "a"}, {"k", "\xCE\xB8"}})
    EXPECT_EQ(code_of_writing(path, pattern(4, 4), {{key, text}}), ExitCode::internal) << key;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Png, SaysWhereItCannotBeCreated) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(code_of_writing(folder.path("missing/a.png"), pattern(9, 9)), ExitCode::cannot_create);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

/// Limits the size of files of this process during its lifetime.
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
    EXPECT_EQ(code_of_writing(folder.path("a.png"), pattern(300, 300)), ExitCode::io_error);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Png, KeepsTheOldFileWhereWritingFails) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("a.png");
  write_png(path, pattern(20, 20));
  {
    const FileSizeLimit limit(1000);
    EXPECT_EQ(code_of_writing(path, pattern(300, 300)), ExitCode::io_error);
  }
  EXPECT_EQ(test::read_png(path).width, 20);
}

}  // namespace
}  // namespace talus::render
