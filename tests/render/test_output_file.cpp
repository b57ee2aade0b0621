#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/errors.h"
#include "render/output_file.h"
#include "support/temporary_folder.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr std::uint8_t text[] = {'a', 'b'};

TEST(OutputFile, appears_when_it_is_whole) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("map.png");
  {
    OutputFile file(path);
    file.write(text);
    EXPECT_FALSE(fs::exists(path));
    file.commit();
    EXPECT_EQ(fs::file_size(path), 2u);
  }
  EXPECT_TRUE(fs::exists(path));
  { OutputFile given_up(path); }
  EXPECT_EQ(fs::file_size(path), 2u);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(OutputFile, takes_the_place_of_what_a_kill_left) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path("map.png.part")) << "half a picture";
  OutputFile file(folder.path("map.png"));
  file.write(text);
  file.commit();
  EXPECT_EQ(fs::file_size(folder.path("map.png")), 2u);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(OutputFile, is_written_by_one_at_a_time) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("map.png");
  OutputFile first(path);
  try {
    const OutputFile second(path);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::cannot_create);
    EXPECT_NE(std::string(error.what()).find("being written by another process"), std::string::npos);
  }
  first.write(text);
  first.commit();
  EXPECT_EQ(fs::file_size(path), 2u);
}

}  // namespace
}  // namespace talus
