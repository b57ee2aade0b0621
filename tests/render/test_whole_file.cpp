#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/errors.h"
#include "render/movie.h"
#include "render/png.h"
#include "render/whole_file.h"
#include "support/temporary_folder.h"

namespace talus {
namespace {

/// Some ten bytes of each kind of element.
constexpr const char* drawing =
    "<?xml version=\"1.0\"?>\n<!-- a > b -->\n<svg width='9'>\n<g a=\"1>2\"><path d=\"M1,1\"/></g>\n</svg>\n";

std::string document() {
  const std::string head = "%PDF-1.5\n", first = "1 0 obj\n<<>>\nendobj\n",
                    second = "2 0 obj\n<<>>\nendobj\n";
  const auto row = [](std::size_t at, char kind) {
    const std::string digits = std::to_string(at);
    return std::string(10 - digits.size(), '0') + digits + " 00000 " + kind + " \n";
  };
  return head + first + second + "xref\n0 3\n" + row(0, 'f') + row(head.size(), 'n') +
         row(head.size() + first.size(), 'n') + "trailer\n<<>>\nstartxref\n" +
         std::to_string(head.size() + first.size() + second.size()) + "\n%%EOF\n";
}

Image checkers(int shift) {
  Image image{48, 32, 1, {}};
  for (int k = 0; k < 48 * 32; ++k)
    image.pixels.push_back(static_cast<std::uint8_t>(((k % 48 + shift) / 8 + k / 48 / 8) % 2 * 255));
  return image;
}

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A file of each kind, whole.
std::string whole(const test::TemporaryFolder& folder, const std::string& ending) {
  std::string path = folder.path("a" + ending);
  if (ending == ".svg") std::ofstream(path) << drawing;
  if (ending == ".pdf") std::ofstream(path) << document();
  if (ending == ".png") write_png(path, checkers(0));
  if (ending == ".mp4" || ending == ".webm" || ending == ".gif") {
    Movie movie(path, 48, 32, 1, 10.0);
    for (int k = 0; k < 5; ++k) movie.add(checkers(k));
    movie.finish();
  }
  return path;
}

class WholeFile : public testing::TestWithParam<const char*> {};

TEST_P(WholeFile, is_not_whole_at_any_smaller_length) {
  const test::TemporaryFolder folder;
  const std::string ending = GetParam(), path = whole(folder, ending), cut = folder.path("cut");
  const std::string bytes = content(path);
  EXPECT_TRUE(is_whole_file(path, path));
  std::size_t most = bytes.size();
  while (bytes[most - 1] == '\n') --most;  // an end of line more or less is no matter in a text
  for (std::size_t size = 0; size < most; ++size) {
    std::ofstream(cut, std::ios::binary) << bytes.substr(0, size);
    ASSERT_FALSE(is_whole_file(cut, path)) << size << " of " << bytes.size();
  }
}

TEST_P(WholeFile, is_not_whole_with_a_hole) {
  const test::TemporaryFolder folder;
  const std::string ending = GetParam(), path = whole(folder, ending), cut = folder.path("cut");
  const std::string bytes = content(path);
  const std::size_t hole = bytes.size() / 3;
  std::ofstream(cut, std::ios::binary) << bytes.substr(0, hole) + bytes.substr(2 * hole);
  EXPECT_FALSE(is_whole_file(cut, path));
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, WholeFile,
                         testing::Values(".png", ".mp4", ".webm", ".gif", ".pdf", ".svg"),
                         [](const auto& kind) { return std::string(kind.param).substr(1); });

TEST(WholeFileOf, another_kind_is_a_defect) {
  EXPECT_THROW(is_whole_file("a.txt", "a.txt"), Error);
  EXPECT_FALSE(is_whole_file("/nowhere/a.svg", "a.svg"));
}

}  // namespace
}  // namespace talus
