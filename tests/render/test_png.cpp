#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>

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

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
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
  const test::TemporaryFolder folder;
  const std::string path = folder.path("a.png");
  write_png(path, pattern(30, 20),
            {{"Key", "first"}, {"Keyword", "a=1 b=[2]"}, {"Key", "second"}, {"None", ""}});
  EXPECT_EQ(png_text(path, "Key"), "first");
  EXPECT_EQ(png_text(path, "Keyword"), "a=1 b=[2]");
  EXPECT_EQ(png_text(path, "None"), "");
  EXPECT_EQ(png_text(path, "Ke"), std::nullopt);
  EXPECT_EQ(png_text(path, ""), std::nullopt);
}

TEST(Png, SaysHowWideItIsPrinted) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("a.png");
  write_png(path, pattern(1016, 20), {{"Key", "text"}}, 0.086);
  EXPECT_EQ(test::read_png(path).pixels, pattern(1016, 20).pixels);
  EXPECT_EQ(png_text(path, "Key"), "text") << "its checksums are correct";
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

TEST(Png, ReadsTextsOfOthers) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("a.png");
  std::FILE* file = std::fopen(path.c_str(), "wb");
  png_structp writer = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(writer);
  png_init_io(writer, file);
  png_set_IHDR(writer, info, 3, 1, 8, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  std::string key = "Software", value = "libpng";
  png_text_struct text{};
  text.compression = PNG_TEXT_COMPRESSION_NONE;
  text.key = key.data();
  text.text = value.data();
  text.text_length = value.size();
  png_set_text(writer, info, &text, 1);
  png_write_info(writer, info);
  const std::array<png_byte, 3> row = {1, 2, 3};
  png_write_row(writer, row.data());
  png_write_end(writer, info);
  png_destroy_write_struct(&writer, &info);
  std::fclose(file);
  EXPECT_EQ(png_text(path, "Software"), "libpng");
}

TEST(Png, HasNoTextWhereDamaged) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("a.png"), key = "Key";
  write_png(path, pattern(9, 5), {{key, "text"}});
  const std::string whole = bytes_of(path);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    write_bytes(path, whole.substr(0, size));
    EXPECT_EQ(png_text(path, key), std::nullopt) << "cut to " << size << " bytes";
  }
  for (std::size_t k = 0; k < whole.size(); ++k) {
    std::string other = whole;
    other[k] = static_cast<char>(other[k] ^ 0x41);
    write_bytes(path, other);
    EXPECT_EQ(png_text(path, key), std::nullopt) << "byte " << k << " changed";
  }
  write_bytes(path, whole);
  EXPECT_EQ(png_text(path, key), "text");
}

TEST(Png, HasNoTextWhereThereIsNoPng) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(png_text(folder.path("missing.png"), "Key"), std::nullopt);
  EXPECT_EQ(png_text(folder.path(""), "Key"), std::nullopt) << "a folder";
  EXPECT_EQ(png_text("/dev/zero", "Key"), std::nullopt);
  ASSERT_EQ(mkfifo(folder.path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(png_text(folder.path("pipe"), "Key"), std::nullopt) << "and does not block";
  write_bytes(folder.path("a.png"), "not a picture, and long enough to be one");
  EXPECT_EQ(png_text(folder.path("a.png"), "Key"), std::nullopt);
  // A text chunk that claims 4 GB.
  write_bytes(folder.path("a.png"), std::string("\x89PNG\r\n\x1a\n\xff\xff\xff\xfftEXtKey\0text", 24));
  EXPECT_EQ(png_text(folder.path("a.png"), "Key"), std::nullopt);
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
