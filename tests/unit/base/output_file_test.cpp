#include "base/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>
#include <iterator>

#include "base/descriptor.h"
#include "base/errors.h"
#include "support/exit_code.h"
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
  std::ofstream(folder.path("map.png.talus.part")) << "half a picture";
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
    ADD_FAILURE() << "no error was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::cannot_create);
    EXPECT_NE(std::string(error.what()).find("being written by another process"), std::string::npos);
  }
  first.write(text);
  first.commit();
  EXPECT_EQ(fs::file_size(path), 2u);
}

/// Returns the exit code with which an output is rejected, or `done` if it is accepted.
ExitCode code_of(const std::string& path, const OutputRule& rule = {}) {
  return test::exit_code_of([&] { output_target(path, rule); });
}

std::string content_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The name is looked at when a command begins, and the file appears when it ends.
TEST(OutputFile, replaces_nothing_that_has_appeared_under_its_name) {
  const test::TemporaryFolder folder;
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
  EXPECT_EQ(content_of(path), "precious");
  EXPECT_EQ(content_of(made), "made");
  fs::remove(path);
  for (const char* ours : {"1", "2"}) {  // a process may replace what it has written itself
    std::ofstream(made) << ours;
    publish_file(made, path);
    EXPECT_EQ(content_of(path), ours);
  }
  keep_free(path);
  allow_replacing(path);
  std::ofstream(made) << "3";
  publish_file(made, path);
  EXPECT_EQ(content_of(path), "3");
}

TEST(OutputFile, leaves_nothing_where_a_signal_ends_the_process) {
  const test::TemporaryFolder folder;
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

TEST(OutputTarget, is_a_file_or_what_a_link_leads_to) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("file"), link = folder.path("link");
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

TEST(OutputTarget, is_no_file_that_is_write_protected) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("file"), link = folder.path("link");
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

TEST(OutputTarget, is_not_what_a_process_has_open) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("file");
  std::ofstream(file) << "x";
  const Descriptor open(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  EXPECT_EQ(code_of(fmt::format("/dev/fd/{}", open.get())), ExitCode::cannot_create);
}

TEST(OutputTarget, is_no_input_under_any_name) {
  const test::TemporaryFolder folder;
  const std::string file = folder.path("file"), inside = folder.path("run/part");
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
  std::ifstream written(path);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(written), {}), "12\n34\n");
}

TEST(OutputFile, is_not_whole_where_bytes_are_missing) {
  const test::TemporaryFolder folder;
  OutputFile file(folder.path("file"));
  file.write(text);
  fs::resize_file(file.temporary_path(), 1);
  EXPECT_THROW(file.commit(), Error);
  EXPECT_FALSE(fs::exists(folder.path("file")));
}

TEST(OutputFile, keeps_the_mode_and_the_link_of_what_it_replaces) {
  const test::TemporaryFolder folder;
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

TEST(OutputFile, gives_a_name_to_what_another_program_made) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path("made")) << "abc";
  publish_file(folder.path("made"), folder.path("file"));
  EXPECT_EQ(fs::file_size(folder.path("file")), 3u);
  EXPECT_FALSE(fs::exists(folder.path("made")));
}

}  // namespace
}  // namespace talus
