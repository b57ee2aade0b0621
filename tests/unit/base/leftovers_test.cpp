#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <set>
#include <thread>

#include "base/descriptor.h"
#include "base/locked_file.h"
#include "support/temporary_folder.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

void write(const std::string& path) { std::ofstream(path) << "half"; }

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

TEST(Leftovers, are_removed_whatever_they_were_to_become) {
  const test::TemporaryFolder folder;
  for (const char* name : {"map.png.talus.part", "run.h5.talus.part"}) write(folder.path(name));
  for (const char* name : {"fig04-shear-stress.talus.part", "fig05-empty.talus.part"})
    fs::create_directory(folder.path(name));
  for (const char* name : {"fig04-shear-stress.pdf", "fig04-shear-stress.csv.talus.part"})
    write(folder.path("fig04-shear-stress.talus.part/" + std::string(name)));
  clear_leftovers(folder.path().string());
  EXPECT_TRUE(fs::is_empty(folder.path()));
  clear_leftovers(folder.path("nowhere"));
}

TEST(Leftovers, all_else_stays) {
  const test::TemporaryFolder folder;
  const auto make = [&folder](const std::string& name) { write(folder.path(name)); };
  for (const char* name : {"mine.part", "talus.part", ".talus.part", "a.talus.part.bak", "map.png"})
    make(name);
  fs::create_symlink("mine.part", folder.path("link.talus.part"));
  ASSERT_EQ(mkfifo(folder.path("fifo.talus.part").c_str(), 0600), 0);
  for (const char* name : {"map.png.talus.part", "fig04.talus.part", "fig05.talus.part"})
    fs::create_directory(folder.path(name));
  make("fig04.talus.part/fig04.pdf");
  make("fig04.talus.part/notes");  // marks the folder as foreign
  fs::create_directory(folder.path("fig05.talus.part/fig05-more"));
  const std::set<std::string> before = names_in(folder.path());
  clear_leftovers(folder.path().string());
  EXPECT_EQ(names_in(folder.path()), before);
  EXPECT_EQ(names_in(folder.path("fig04.talus.part")).size(), 2u);
}

TEST(Leftovers, of_another_user_stay) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root, to change the owner of files";
  const test::TemporaryFolder folder;
  const std::string path = folder.path("map.png.talus.part");
  write(path);
  ASSERT_EQ(chown(path.c_str(), 1234, 1234), 0);
  clear_leftovers(folder.path().string());
  EXPECT_TRUE(fs::exists(path));
}

TEST(Leftovers, that_somebody_writes_are_none) {
  const test::TemporaryFolder folder;
  const auto file = create_locked(folder.path("map.png.talus.part"));
  const auto figure = create_locked_folder(folder.path("fig04.talus.part"));
  write(folder.path("fig04.talus.part/fig04.pdf"));
  clear_leftovers(folder.path().string());
  EXPECT_TRUE(is_named(folder.path("map.png.talus.part"), *file));
  EXPECT_TRUE(is_named(folder.path("fig04.talus.part"), *figure));
  EXPECT_TRUE(fs::exists(folder.path("fig04.talus.part/fig04.pdf")));
}

TEST(Leftovers, are_left_to_who_clears_the_folder_already) {
  const test::TemporaryFolder folder;
  write(folder.path("map.png.talus.part"));
  {
    const Descriptor other(::open(folder.path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    ASSERT_EQ(::flock(other.get(), LOCK_EX), 0);
    clear_leftovers(folder.path().string());
    EXPECT_TRUE(fs::exists(folder.path("map.png.talus.part")));
  }
  clear_leftovers(folder.path().string());
  EXPECT_FALSE(fs::exists(folder.path("map.png.talus.part")));
}

/// Two threads clean up continuously while two others create, abandon and recreate files.
TEST(Leftovers, are_told_from_what_is_just_being_made) {
  const test::TemporaryFolder folder;
  std::atomic<bool> ended = false;
  const auto clear = [&] {
    while (!ended) clear_leftovers(folder.path().string());
  };
  const auto make = [](const std::string& path, const auto& create) {
    for (int k = 0; k < 150; ++k) {
      const auto held = create(path);
      ASSERT_TRUE(held) << "rejected although nobody else has it, attempt " << k;
      ASSERT_TRUE(is_named(path, *held)) << "it was removed, attempt " << k;
      std::this_thread::yield();
      ASSERT_TRUE(is_named(path, *held)) << "it was removed while being written, attempt " << k;
    }  // state after a kill: the lock is free, the name remains
  };
  std::thread first(clear), second(clear);
  std::thread files(make, folder.path("map.png.talus.part"), create_locked);
  make(folder.path("fig04.talus.part"), create_locked_folder);
  files.join();
  ended = true;
  first.join();
  second.join();
}

}  // namespace
}  // namespace talus
