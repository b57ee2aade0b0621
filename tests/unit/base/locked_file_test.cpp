#include "base/locked_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "base/errors.h"
#include "support/temporary_folder.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

TEST(LockedFile, is_made_by_one_at_a_time) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("file");
  std::optional<Descriptor> first = create_locked(path);
  ASSERT_TRUE(first);
  EXPECT_FALSE(create_locked(path));
  EXPECT_TRUE(is_named(path, *first)) << "the second attempt has removed it";
  first->close();
  EXPECT_TRUE(create_locked(path));
}

TEST(LockedFile, replaces_what_a_kill_left) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("file");
  std::ofstream left(path);
  left << "half" << std::flush;
  const std::optional<Descriptor> file = create_locked(path);
  ASSERT_TRUE(file);
  left << "more of it from a child that lives on" << std::flush;
  EXPECT_EQ(fs::file_size(path), 0u);
}

TEST(LockedFile, is_free_again_under_its_name_once_it_has_another) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("file");
  const std::optional<Descriptor> file = create_locked(path);
  fs::rename(path, folder.path("final"));
  EXPECT_FALSE(is_named(path, *file));
  EXPECT_TRUE(create_locked(path));
  EXPECT_TRUE(is_named(folder.path("final"), *file));
}

TEST(LockedFile, waits_for_nothing_and_removes_nothing_that_is_no_file) {
  const test::TemporaryFolder folder;
  const auto code_of = [](const auto& make) {
    try {
      make();
    } catch (const Error& error) {
      return error.code();
    }
    return ExitCode::done;
  };
  fs::create_symlink("/nowhere/x", folder.path("nowhere"));
  fs::create_symlink("loop", folder.path("loop"));
  fs::create_directory(folder.path("folder"));
  ASSERT_EQ(mkfifo(folder.path("fifo").c_str(), 0600), 0);
  for (const char* name : {"nowhere", "loop", "folder", "fifo"}) {
    EXPECT_EQ(code_of([&] { create_locked(folder.path(name)); }), ExitCode::cannot_create) << name;
    EXPECT_TRUE(fs::exists(fs::symlink_status(folder.path(name)))) << name;
  }
}

TEST(LockedFile, says_why_it_cannot_be_made) {
  const auto code_of = [](const std::string& path) {
    try {
      create_locked(path);
    } catch (const Error& error) {
      return error.code();
    }
    return ExitCode::done;
  };
  EXPECT_EQ(code_of("/nowhere/file"), ExitCode::cannot_create);
  EXPECT_EQ(creation_error("create", "file", EACCES).code(), ExitCode::cannot_create);
  EXPECT_EQ(creation_error("create", "file", ENOSPC).code(), ExitCode::io_error);
  EXPECT_EQ(creation_error("create", "file", EIO).code(), ExitCode::io_error);
}

}  // namespace
}  // namespace talus
