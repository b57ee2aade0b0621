/// Output files: complete or absent, locked while they are written, and what a kill leaves.

#include "base/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <iterator>
#include <set>
#include <thread>

#include "base/errors.h"
#include "base/locked_file.h"
#include "support/exit_code.h"
#include "support/process.h"
#include "support/temporary_folder.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr std::uint8_t text[] = {'a', 'b'};

using OutputFileTest = test::FolderTest;

TEST_F(OutputFileTest, appears_when_it_is_whole) {
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

TEST_F(OutputFileTest, takes_the_place_of_what_a_kill_left) {
  std::ofstream(folder.path("map.png.talus.part")) << "half a picture";
  OutputFile file(folder.path("map.png"));
  file.write(text);
  file.commit();
  EXPECT_EQ(fs::file_size(folder.path("map.png")), 2u);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST_F(OutputFileTest, is_written_by_one_at_a_time) {
  const std::string path = folder.path("map.png");
  OutputFile first(path);
  EXPECT_TRUE(test::refuses([&] { const OutputFile second(path); }, ExitCode::cannot_create,
                            {"being written by another process"}));
  first.write(text);
  first.commit();
  EXPECT_EQ(fs::file_size(path), 2u);
}

/// Returns the exit code with which an output is rejected, or `done` if it is accepted.
ExitCode code_of(const std::string& path, const OutputRule& rule = {}) {
  return test::exit_code_of([&] { output_target(path, rule); });
}

// The name is looked at when a command begins, and the file appears when it ends.
TEST_F(OutputFileTest, replaces_nothing_that_has_appeared_under_its_name) {
  const std::string path = folder.path("map.png"), made = folder.path("made");
  const OutputRule rule{.overwrite = false};
  EXPECT_EQ(output_target(path, rule), path);
  {
    OutputFile file(path);
    file.write(text);
    std::ofstream(path) << "precious";
    EXPECT_EQ(test::exit_code_of([&] { file.commit(); }), ExitCode::cannot_create);
  }
  std::ofstream(made) << "made";
  EXPECT_EQ(test::exit_code_of([&] { publish_file(made, path); }), ExitCode::cannot_create);
  EXPECT_EQ(test::text_of(path), "precious");
  EXPECT_EQ(test::text_of(made), "made");
  fs::remove(path);
  for (const char* ours : {"1", "2"}) {  // a process may replace what it has written itself
    std::ofstream(made) << ours;
    publish_file(made, path);
    EXPECT_EQ(test::text_of(path), ours);
  }
  keep_free(path);
  allow_replacing(path);
  std::ofstream(made) << "3";
  publish_file(made, path);
  EXPECT_EQ(test::text_of(path), "3");
}

TEST_F(OutputFileTest, leaves_nothing_where_a_signal_ends_the_process) {
  OutputFile whole(folder.path("whole.png"));
  whole.write(text);
  whole.commit();
  const pid_t child = fork();
  if (child == 0) {
    const OutputFile first(folder.path("first.png")), second(folder.path("second.png"));
    remove_unfinished_files();
    _exit(fs::exists(first.temporary_path()) || fs::exists(second.temporary_path()) ? 1 : 0);
  }
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

class OutputTarget : public test::FolderTest {
 protected:
  const std::string file = folder.path("file");
};

TEST_F(OutputTarget, is_a_file_or_what_a_link_leads_to) {
  const std::string link = folder.path("link");
  EXPECT_EQ(output_target(file), file) << "that file is created";
  std::ofstream(file) << "x";
  fs::create_symlink("file", link);
  EXPECT_EQ(output_target(file), file);
  EXPECT_EQ(output_target(link), fs::canonical(file).string());
  EXPECT_EQ(code_of(file, {.overwrite = false}), ExitCode::cannot_create);
  EXPECT_EQ(code_of(folder.path()), ExitCode::cannot_create);
  EXPECT_EQ(code_of(folder.path("new/")), ExitCode::cannot_create);
  EXPECT_EQ(code_of("/dev/null"), ExitCode::cannot_create);
  EXPECT_EQ(code_of(""), ExitCode::usage);
  fs::remove(file);
  EXPECT_EQ(code_of(link), ExitCode::cannot_create) << "the link leads nowhere";
}

TEST_F(OutputTarget, is_no_file_that_is_write_protected) {
  const std::string link = folder.path("link");
  std::ofstream(file) << "x";
  fs::create_symlink("file", link);
  EXPECT_EQ(protection_of(file), "");
  ASSERT_EQ(chmod(file.c_str(), 0444), 0);
  for (const std::string& path : {file, link}) {
    EXPECT_EQ(code_of(path), ExitCode::cannot_create);
    EXPECT_EQ(protection_of(path), "the file is write-protected (mode 0444)");
  }
  ASSERT_EQ(chmod(file.c_str(), 0644), 0);
  EXPECT_EQ(code_of(file), ExitCode::done);
  EXPECT_EQ(protection_of(folder.path("none")), "");
}

TEST_F(OutputTarget, is_not_what_a_process_has_open) {
  std::ofstream(file) << "x";
  const Descriptor open(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  EXPECT_EQ(code_of(fmt::format("/dev/fd/{}", open.get())), ExitCode::cannot_create);
}

TEST_F(OutputTarget, is_no_input_under_any_name) {
  const std::string inside = folder.path("run/part");
  std::ofstream(file) << "x";
  fs::create_symlink("file", folder.path("link"));
  fs::create_hard_link(file, folder.path("other"));
  fs::create_directory(folder.path("run"));
  std::ofstream(inside) << "x";
  const OutputRule rule = {true, {folder.path("link"), folder.path("run"), folder.path("none")}};
  for (const std::string& path : {file, folder.path("link"), folder.path("other"), inside})
    EXPECT_EQ(code_of(path, rule), ExitCode::usage) << path;
  EXPECT_EQ(code_of(folder.path("run/new"), rule), ExitCode::done);
}

TEST(MemoryFile, holds_what_another_program_writes) {
  const test::TemporaryFolder folder;
  const std::string path = folder.path("file");
  const MemoryFile made(path);
  OutputFile file(path);
  EXPECT_THROW(made.copy_to(file), Error) << "nothing was written";
  ASSERT_EQ(std::system(("echo 12 > " + made.path() + "; echo 34 >> " + made.path()).c_str()), 0);
  made.copy_to(file);
  file.commit();
  EXPECT_EQ(test::text_of(path), "12\n34\n");
}

TEST_F(OutputFileTest, is_not_whole_where_bytes_are_missing) {
  OutputFile file(folder.path("file"));
  file.write(text);
  fs::resize_file(file.temporary_path(), 1);
  EXPECT_THROW(file.commit(), Error);
  EXPECT_FALSE(fs::exists(folder.path("file")));
}

TEST_F(OutputFileTest, keeps_the_mode_and_the_link_of_what_it_replaces) {
  const std::string path = folder.path("file"), link = folder.path("link");
  std::ofstream(path) << "x";
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("file", link);
  OutputFile file(link);
  file.write(text);
  file.commit();
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(fs::file_size(path), 2u);
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(OutputFileTest, gives_a_name_to_what_another_program_made) {
  std::ofstream(folder.path("made")) << "abc";
  publish_file(folder.path("made"), folder.path("file"));
  EXPECT_EQ(fs::file_size(folder.path("file")), 3u);
  EXPECT_FALSE(fs::exists(folder.path("made")));
}

void write(const std::string& path) { std::ofstream(path) << "half"; }

using Leftovers = test::FolderTest;

TEST_F(Leftovers, are_removed_whatever_they_were_to_become) {
  for (const char* name : {"map.png.talus.part", "run.h5.talus.part"}) write(folder.path(name));
  for (const char* name : {"fig04-shear-stress.talus.part", "fig05-empty.talus.part"})
    fs::create_directory(folder.path(name));
  for (const char* name : {"fig04-shear-stress.pdf", "fig04-shear-stress.csv.talus.part"})
    write(folder.path("fig04-shear-stress.talus.part/" + std::string(name)));
  clear_leftovers(folder.path().string());
  EXPECT_TRUE(fs::is_empty(folder.path()));
  clear_leftovers(folder.path("nowhere"));
}

TEST_F(Leftovers, all_else_stays) {
  const auto make = [this](const std::string& name) { write(folder.path(name)); };
  for (const char* name : {"mine.part", "talus.part", ".talus.part", "a.talus.part.bak", "map.png"})
    make(name);
  fs::create_symlink("mine.part", folder.path("link.talus.part"));
  ASSERT_EQ(mkfifo(folder.path("fifo.talus.part").c_str(), 0600), 0);
  for (const char* name : {"map.png.talus.part", "fig04.talus.part", "fig05.talus.part"})
    fs::create_directory(folder.path(name));
  make("fig04.talus.part/fig04.pdf");
  make("fig04.talus.part/notes");  // marks the folder as foreign
  fs::create_directory(folder.path("fig05.talus.part/fig05-more"));
  const std::set<std::string> before = test::names_in(folder.path());
  clear_leftovers(folder.path().string());
  EXPECT_EQ(test::names_in(folder.path()), before);
  EXPECT_EQ(test::names_in(folder.path("fig04.talus.part")).size(), 2u);
}

TEST_F(Leftovers, of_another_user_stay) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root, to change the owner of files";
  const std::string path = folder.path("map.png.talus.part");
  write(path);
  ASSERT_EQ(chown(path.c_str(), 1234, 1234), 0);
  clear_leftovers(folder.path().string());
  EXPECT_TRUE(fs::exists(path));
}

TEST_F(Leftovers, that_somebody_writes_are_none) {
  const auto file = create_locked(folder.path("map.png.talus.part"));
  fs::create_directory(folder.path("fig04.talus.part"));
  const Descriptor figure(
      ::open(folder.path("fig04.talus.part").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  ASSERT_EQ(::flock(figure.get(), LOCK_EX), 0);
  write(folder.path("fig04.talus.part/fig04.pdf"));
  clear_leftovers(folder.path().string());
  EXPECT_TRUE(is_named(folder.path("map.png.talus.part"), *file));
  EXPECT_TRUE(fs::exists(folder.path("fig04.talus.part/fig04.pdf")));
}

TEST_F(Leftovers, are_left_to_who_clears_the_folder_already) {
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
TEST_F(Leftovers, are_told_from_what_is_just_being_made) {
  std::atomic<bool> ended = false;
  const auto clear = [&] {
    while (!ended) clear_leftovers(folder.path().string());
  };
  const auto make = [](const std::string& path) {
    for (int k = 0; k < 150; ++k) {
      const auto held = create_locked(path);
      ASSERT_TRUE(held) << "rejected although nobody else has it, attempt " << k;
      ASSERT_TRUE(is_named(path, *held)) << "it was removed, attempt " << k;
      std::this_thread::yield();
      ASSERT_TRUE(is_named(path, *held)) << "it was removed while being written, attempt " << k;
    }  // state after a kill: the lock is free, the name remains
  };
  std::thread first(clear), second(clear);
  std::thread other(make, folder.path("map.png.talus.part"));
  make(folder.path("run.h5.talus.part"));
  other.join();
  ended = true;
  first.join();
  second.join();
}

class LockedFile : public test::FolderTest {
 protected:
  const std::string path = folder.path("file");
};

TEST_F(LockedFile, is_made_by_one_at_a_time) {
  std::optional<Descriptor> first = create_locked(path);
  ASSERT_TRUE(first);
  EXPECT_FALSE(create_locked(path));
  EXPECT_TRUE(is_named(path, *first)) << "the second attempt has removed it";
  first->close();
  EXPECT_TRUE(create_locked(path));
}

TEST_F(LockedFile, replaces_what_a_kill_left) {
  std::ofstream left(path);
  left << "half" << std::flush;
  const std::optional<Descriptor> file = create_locked(path);
  ASSERT_TRUE(file);
  left << "more of it from a child that lives on" << std::flush;
  EXPECT_EQ(fs::file_size(path), 0u);
}

TEST_F(LockedFile, is_free_again_under_its_name_once_it_has_another) {
  const std::optional<Descriptor> file = create_locked(path);
  fs::rename(path, folder.path("final"));
  EXPECT_FALSE(is_named(path, *file));
  EXPECT_TRUE(create_locked(path));
  EXPECT_TRUE(is_named(folder.path("final"), *file));
}

TEST_F(LockedFile, waits_for_nothing_and_removes_nothing_that_is_no_file) {
  fs::create_symlink("/nowhere/x", folder.path("nowhere"));
  fs::create_symlink("loop", folder.path("loop"));
  fs::create_directory(folder.path("folder"));
  ASSERT_EQ(mkfifo(folder.path("fifo").c_str(), 0600), 0);
  for (const char* name : {"nowhere", "loop", "folder", "fifo"}) {
    EXPECT_EQ(test::exit_code_of([&] { create_locked(folder.path(name)); }), ExitCode::cannot_create) << name;
    EXPECT_TRUE(fs::exists(fs::symlink_status(folder.path(name)))) << name;
  }
}

TEST_F(LockedFile, says_why_it_cannot_be_made) {
  EXPECT_EQ(test::exit_code_of([] { create_locked("/nowhere/file"); }), ExitCode::cannot_create);
  EXPECT_EQ(creation_error("create", "file", EACCES).code(), ExitCode::cannot_create);
  EXPECT_EQ(creation_error("create", "file", ENOSPC).code(), ExitCode::io_error);
  EXPECT_EQ(creation_error("create", "file", EIO).code(), ExitCode::io_error);
}

}  // namespace
}  // namespace talus
