/// Commands replace only what they may, do not block, and leave nothing behind. Outputs of commands are
/// complete or absent, on a disk of any size and under any limit. ctest tries a few sizes; with
/// TALUS_RELIABILITY=1, every block up to a sufficient size.

#include "reliability/outputs.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <map>

#include "reliability/small_disk.h"
#include "support/resource_limit.h"

namespace talus::test {
namespace {

/// Function that creates something other than a file under a name.
using Make = std::function<void(const std::string&)>;

const std::map<std::string, Make>& strange_kinds() {
  static const std::map<std::string, Make> kinds = {
      {"a FIFO", [](const std::string& name) { ASSERT_EQ(mkfifo(name.c_str(), 0600), 0); }},
      {"a link that leads nowhere", [](const std::string& name) { fs::create_symlink("/nowhere/x", name); }},
      {"a link to itself",
       [](const std::string& name) { fs::create_symlink(fs::path(name).filename(), name); }},
      {"a folder", [](const std::string& name) { fs::create_directory(name); }},
      {"a link to a device", [](const std::string& name) { fs::create_symlink("/dev/null", name); }},
      {"a socket",
       [](const std::string& name) {
         const int made = socket(AF_UNIX, SOCK_STREAM, 0);
         sockaddr_un address{};
         address.sun_family = AF_UNIX;
         name.copy(address.sun_path, sizeof address.sun_path - 1);
         ASSERT_EQ(bind(made, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
         close(made);
       }},
  };
  return kinds;
}

/// Returns the identity of the entry under a name, without following links.
std::pair<ino_t, mode_t> identity(const std::string& name) {
  struct stat status {};
  EXPECT_EQ(lstat(name.c_str(), &status), 0);
  return {status.st_ino, status.st_mode};
}

TEST_F(Outputs, replace_nothing_but_files) {
  for (const Writer& writer : writers()) {
    if (writer.of_folder) continue;
    for (const auto& [kind, make] : strange_kinds()) {
      SCOPED_TRACE(writer.name + ", " + kind);
      const std::string output =
          path(writer.output.substr(0, 1) + "-strange" + fs::path(writer.output).extension().string());
      make(output);
      const auto before = identity(output);
      for (const bool overwrite : {false, true}) {
        Words words = with_output(writer.words, output);
        if (overwrite) words.emplace_back("--overwrite");
        EXPECT_TRUE(ends(talus(words), refused));
        EXPECT_EQ(identity(output), before);
      }
      fs::remove(output);
    }
  }
}

TEST_F(Outputs, wait_for_nothing_that_has_the_name_of_a_lock_or_a_temporary_file) {
  for (const Writer& writer : writers())
    for (const auto& [kind, make] : strange_kinds()) {
      SCOPED_TRACE(writer.name + ", " + kind);
      fs::create_directory(path("place"));
      const bool is_run = writer.name == "run" || writer.name == "replay";
      const std::string name = is_run                     ? "r.h5.run/lock"
                               : writer.name == "figures" ? "figs/fig04-shear-stress.talus.part"
                               : writer.name == "render"  ? "maps/pressure_000.00.png.talus.part"
                                                          : writer.output + ".talus.part";
      const std::string there = path("place/" + name);
      fs::create_directories(fs::path(there).parent_path());
      make(there);
      const auto before = identity(there);
      const Outcome outcome = talus(with_output(writer.words, "place/" + writer.output));
      // A killed process leaves an empty folder of figures.
      if (writer.name == "figures" && kind == "a folder") {
        EXPECT_EQ(outcome.exit_code, done) << outcome.err;
      } else {
        EXPECT_EQ(outcome.exit_code, refused) << outcome.err;
        EXPECT_EQ(identity(there), before);
      }
      fs::remove_all(path("place"));
    }
}

TEST_F(Outputs, never_replace_what_is_read) {
  const std::map<std::string, std::string> inputs = {
      {"run", "bed.toml"}, {"repair", "damaged.h5"}, {"solve", "p.h5"}};
  for (const Writer& writer : writers()) {
    if (writer.of_folder) continue;
    SCOPED_TRACE(writer.name);
    const std::string input = inputs.contains(writer.name) ? inputs.at(writer.name) : "f.h5";
    const std::string before = text_of(path(input)), ending = fs::path(writer.output).extension();
    const std::string other = "other" + ending, link = "link" + ending;
    fs::create_hard_link(path(input), path(other));
    fs::create_symlink(input, path(link));
    for (const std::string& output : {other, link, input}) {
      if (!output.ends_with(ending)) continue;  // a movie or a picture rejects it by its name
      Words words = with_output(writer.words, output) + Words{"--overwrite"};
      EXPECT_TRUE(ends(talus(words), usage)) << output;
      EXPECT_TRUE(text_of(path(input)) == before) << output;
    }
    fs::remove(path(other));
    fs::remove(path(link));
  }
}

TEST_F(Outputs, never_replace_the_bed_that_a_run_begins_with) {
  const std::string before = text_of(path("f.h5"));
  EXPECT_TRUE(ends(talus({"run", "bed.toml", "--set", "deposition.method=file", "--set",
                          "deposition.file=f.h5", "-o", "f.h5", "--overwrite"}),
                   usage));
  EXPECT_TRUE(text_of(path("f.h5")) == before);
}

TEST_F(Outputs, written_again_keep_mode_owner_and_link) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root, to change the owner of files";
  const auto expect_kept = [this](const std::string& file, const Words& words) {
    SCOPED_TRACE(words[0]);
    const std::string link = "link-" + file;
    fs::create_symlink(file, path(link));
    ASSERT_EQ(chown(path(file).c_str(), 1234, 4321), 0);
    ASSERT_EQ(chmod(path(file).c_str(), 0640), 0);
    struct stat before {
    }, after{};
    stat(path(file).c_str(), &before);
    EXPECT_TRUE(ends(talus(with_output(words, link)), done));
    EXPECT_TRUE(fs::is_symlink(path(link)));
    stat(path(file).c_str(), &after);
    EXPECT_NE(after.st_ino, before.st_ino) << "it was not rewritten";
    EXPECT_EQ(after.st_mode & 07777, 0640u);
    EXPECT_EQ(after.st_uid, 1234u);
    EXPECT_EQ(after.st_gid, 4321u);
    fs::remove(path(link));
  };
  expect_kept("f.h5", {"analyze", "OUT", "-q", "--force"});
  for (const Writer& writer : writers()) {
    if (writer.of_folder) continue;
    const std::string old = "old" + fs::path(writer.output).extension().string();
    write_file(folder_, old, "earlier content");
    Words words = writer.words + Words{"--overwrite"};
    expect_kept(old, words);
    fs::remove(path(old));
  }
}

TEST_F(Outputs, that_are_write_protected_are_not_replaced) {
  for (const Writer& writer : writers()) {
    if (writer.of_folder) continue;
    SCOPED_TRACE(writer.name);
    const std::string old = "old" + fs::path(writer.output).extension().string();
    write_file(folder_, old, "earlier content");
    ASSERT_EQ(chmod(path(old).c_str(), 0444), 0);
    const auto before = identity(path(old));
    Words words = with_output(writer.words, old) + Words{"--overwrite"};
    EXPECT_TRUE(ends(talus(words), refused, {"write-protected"}));
    EXPECT_EQ(identity(path(old)), before);
    fs::remove(path(old));
  }
}

TEST_F(Outputs, have_no_empty_name) {
  std::vector<Words> commands = {{"study", "bed.toml", "--seeds", "1", "-o", "OUT"},
                                 {"perturb", "bed.toml", "--seeds", "1", "-o", "OUT"},
                                 {"view", "bed.toml", "-o", "OUT"},
                                 {"run", "bed.toml", "--map", "gamma", "--pictures", "OUT"}};
  for (const Writer& writer : writers()) commands.push_back(writer.words);
  const std::set<std::string> before = names_in(folder_.path());
  for (const Words& words : commands) {
    EXPECT_TRUE(ends(talus(with_output(words, "")), usage, {"expected a value, found an empty one"}))
        << words[0];
    std::set<std::string> after = names_in(folder_.path());
    for (const char* printed : {".stdout", ".stderr"}) after.erase(printed);
    EXPECT_EQ(after, before) << words[0];
  }
}

/// Runs commands as an unprivileged user during its lifetime. Requires root.
struct UnprivilegedUser {
  UnprivilegedUser() { EXPECT_EQ(setresuid(nobody, nobody, 0), 0); }
  ~UnprivilegedUser() { EXPECT_EQ(setresuid(0, 0, 0), 0); }
  UnprivilegedUser(const UnprivilegedUser&) = delete;
  UnprivilegedUser& operator=(const UnprivilegedUser&) = delete;
  static constexpr uid_t nobody = 65534;
};

TEST_F(Outputs, runs_that_may_only_be_read_are_analysed_and_drawn) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root, to become another user";
  const CommandFolder own;  // folder of the reader
  ASSERT_EQ(chown(own.path().c_str(), UnprivilegedUser::nobody, UnprivilegedUser::nobody), 0);
  ASSERT_EQ(chmod(folder_.path().c_str(), 0755), 0);
  take_run(folder_, "new.h5", tiny_bed, {"--seed", "2"});
  const std::string run = path("new.h5"), before = text_of(run);
  const auto read_by_nobody = [&](const std::string& reason) {
    SCOPED_TRACE(reason);
    const UnprivilegedUser reader;
    const Outcome drawn = own.talus({"figures", run, "--only", "fig04", "-o", "figs", "--overwrite"});
    if (drawn.exit_code == 127) GTEST_SKIP() << "not every user can read the program";
    EXPECT_EQ(drawn.exit_code, done) << drawn.err;
    EXPECT_TRUE(own.has_file("figs/fig04-shear-stress.pdf"));
    EXPECT_TRUE(has(drawn.err, "analysis not stored: " + reason));
    EXPECT_TRUE(ends(own.talus({"analyze", run, "-q"}), done, {"analysis not stored: " + reason}));
  };
  read_by_nobody("the file is write-protected (mode 0644)");
  ASSERT_EQ(chmod(run.c_str(), 0666), 0);
  read_by_nobody("its folder cannot be written: Permission denied");
  EXPECT_TRUE(text_of(run) == before);
}

TEST_F(Outputs, what_killed_commands_left_is_removed_by_any_that_writes_there) {
  for (const Writer& writer : writers()) {
    SCOPED_TRACE(writer.name);
    const std::string place = writer.of_folder ? "place/" + writer.output : "place";
    fs::create_directories(path(place) + "/fig99-other.talus.part");
    write_file(folder_, place + "/other.mp4.talus.part", "half a movie");
    write_file(folder_, place + "/fig99-other.talus.part/fig99-other.pdf", "half a figure");
    write_file(folder_, place + "/mine.part", "not of Talus");
    EXPECT_TRUE(ends(talus(with_output(writer.words, "place/" + writer.output)), done));
    EXPECT_FALSE(fs::exists(path(place) + "/other.mp4.talus.part"));
    EXPECT_FALSE(fs::exists(path(place) + "/fig99-other.talus.part"));
    EXPECT_TRUE(fs::exists(path(place) + "/mine.part"));
    fs::remove_all(path("place"));
  }
  for (const Words& words :
       {Words{"analyze", "f.h5", "-q", "--force"}, Words{"study", "bed.toml", "--seeds", "1", "-o", "."}}) {
    write_file(folder_, "other.mp4.talus.part", "half a movie");
    EXPECT_EQ(talus(words).exit_code, done);
    EXPECT_FALSE(fs::exists(path("other.mp4.talus.part"))) << words[0];
  }
}

TEST_F(Outputs, a_run_that_is_overwritten_stays_until_the_new_one_is_whole) {
  const std::string before = text_of(path("f.h5"));
  const Words again = {"run", "bed.toml", "--set", "tilt.end_angle=30", "--seed",    "77",
                       "-q",  "-o",       "f.h5",  "--overwrite",       "--threads", "1"};
  const pid_t process = folder_.start(again);
  wait_until([&] { return fs::exists(path("f.h5.run/manifest")) || has_ended(process); });
  kill(process, SIGKILL);
  wait_for(process);
  ASSERT_TRUE(fs::exists(path("f.h5.run/manifest"))) << "too late, so nothing was tested";
  EXPECT_TRUE(text_of(path("f.h5")) == before);
  EXPECT_EQ(io::run_presence(path("f.h5")), io::RunPresence::folder);
  EXPECT_TRUE(ends(talus({"run", "--resume", "f.h5", "-q"}), done));
  EXPECT_FALSE(fs::exists(path("f.h5.run")));
  EXPECT_EQ(io::RunFile::open(path("f.h5")).header().seed, 77u);
}

TEST_F(Outputs, a_full_disk_takes_no_run_away_that_is_overwritten) {
  const SmallDisk disk(folder_.path() / "disk", ample);
  if (!disk.is_mounted()) GTEST_SKIP() << "needs root, to mount a small file system";
  Words words = {"run", "bed.toml", "-q", "-o", "disk/r.h5", "--threads", "1"};
  ASSERT_EQ(talus(words).exit_code, done);
  const std::string before = text_of(path("disk/r.h5"));
  words.emplace_back("--overwrite");
  const int size = static_cast<int>(before.size() / 1024);
  for (const int more : {8, 40, 80, 120}) {
    SCOPED_TRACE(more);
    ASSERT_TRUE(disk.resize(size + more));
    EXPECT_TRUE(ends(talus(words), io_error));
    EXPECT_TRUE(text_of(path("disk/r.h5")) == before);
    ASSERT_TRUE(disk.resize(ample));
    fs::remove_all(path("disk/r.h5.run"));
  }
}

TEST_F(Outputs, an_ensemble_on_a_full_disk_says_so) {
  const Words words = {"ensemble", "bed.toml", "--seeds", "1-2", "--jobs", "1", "-o", "disk/e"};
  for (const int kib : {12, 20, 28, 36, 48}) {  // from the logs of the members, or from their checkpoints
    SCOPED_TRACE(kib);
    const SmallDisk disk(folder_.path() / "disk", kib);
    if (!disk.is_mounted()) GTEST_SKIP() << "needs root, to mount a small file system";
    const Outcome full = talus(words);
    EXPECT_EQ(full.exit_code, io_error) << full.out << full.err;
    EXPECT_TRUE(has(full.out + full.err, "o space")) << full.out << full.err;
    ASSERT_TRUE(disk.resize(ample));
    talus({"ensemble", "retry", "disk/e"});  // does nothing if the ensemble was not begun
    EXPECT_TRUE(ends(talus(words), done));
  }
}

TEST_F(Outputs, have_any_name_that_a_file_can_have) {
  for (const char* name : {"-dash.mp4", "12:30.mp4", "a%d.mp4", "file:x.mp4", "pipe:1.gif", "a'b \"c.webm"}) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(ends(talus({"animate", "f.h5", "-q", "--map", "pressure", "--size", "200", "--every", "2",
                            std::string("--output=") + name}),
                     done));
    EXPECT_TRUE(has_end_of_format(path(name)));
  }
  for (const char* name : {"-dash", "12:30", "a%d b"}) {
    SCOPED_TRACE(name);
    EXPECT_TRUE(
        ends(talus({"figures", "f.h5", "-q", "--only", "fig04", std::string("--output=") + name}), done));
    const Outcome study = talus({"study", "bed.toml", "--seeds", "1", std::string("--output=") + name});
    EXPECT_EQ(study.exit_code, done) << study.err;
    EXPECT_TRUE(fs::exists(fs::path(path(name)) / "study.md"));
    expect_whole(path(name));
  }
}

TEST_F(Outputs, make_the_folder_that_is_missing) {
  for (const Writer& writer : writers()) {
    SCOPED_TRACE(writer.name);
    EXPECT_TRUE(ends(talus(with_output(writer.words, "new/" + writer.name + "/" + writer.output)), done));
    EXPECT_TRUE(fs::exists(path("new/" + writer.name + "/" + writer.output)));
  }
}

TEST_F(Outputs, a_run_folder_on_another_file_system_is_packed) {
  const SmallDisk disk(folder_.path() / "disk", ample);
  if (!disk.is_mounted()) GTEST_SKIP() << "needs root, to mount a small file system";
  fs::create_directory(path("disk/r"));
  fs::create_symlink("disk/r", path("r.h5.run"));
  EXPECT_TRUE(ends(talus({"run", "bed.toml", "-q", "-o", "r.h5", "--threads", "1"}), done));
  EXPECT_EQ(digest(path("r.h5")), digest(path("f.h5")));
  EXPECT_TRUE(fs::is_empty(path("disk/r")));
}

TEST_F(Outputs, a_folder_is_repaired_on_a_full_disk_or_nothing_is_left) {
  fs::create_directory(path("d.h5.run"));
  const pid_t process =
      folder_.start({"run", "bed.toml", "-o", "d.h5", "--set", "tilt.end_angle=30", "--threads", "1"});
  wait_until(
      [&] { return fs::exists(path_beginning(path("d.h5.run"), "segment_000004")) || has_ended(process); });
  kill(process, SIGKILL);
  wait_for(process);
  std::ofstream(path_beginning(path("d.h5.run"), "segment_000002"), std::ios::app) << "?";
  for (const int kib : sizes_about(100)) {
    SCOPED_TRACE(kib);
    const SmallDisk disk(folder_.path() / "disk", kib);
    if (!disk.is_mounted()) GTEST_SKIP() << "needs root, to mount a small file system";
    const Outcome outcome = talus({"repair", "d.h5", "-o", "disk/r.h5"});
    EXPECT_TRUE(outcome.exit_code == done || outcome.exit_code == io_error) << outcome.err;
    EXPECT_EQ(names_in(path("disk")),
              outcome.exit_code == done ? std::set<std::string>{"r.h5"} : std::set<std::string>{});
  }
}

/// Runs a writer in a place of some KiB with the names expected there; returns whether it succeeded.
using TryAt = std::function<bool(const Writer& writer, const std::set<std::string>& expected, int kib)>;

class OutputsOfAllSizes : public Outputs {
 protected:
  /// Tries all writers in places of growing sizes until they succeed. Returns the number of failures.
  int count_too_small(const TryAt& try_at) {
    int tried = 0, too_small = 0;
    for (const Writer& writer : writers()) {
      SCOPED_TRACE(writer.name);
      const auto [expected, size] = undisturbed_files(writer);
      for (const int kib : sizes_about(size)) {
        SCOPED_TRACE(std::to_string(kib) + " KiB");
        ++tried;
        if (try_at(writer, expected, kib)) break;
        ++too_small;
      }
    }
    std::printf("%d places, %d of them too small\n", tried, too_small);
    return too_small;
  }
};

TEST_F(OutputsOfAllSizes, are_whole_or_absent_on_small_disks) {
  if (geteuid() != 0) GTEST_SKIP() << "needs root, to mount a small file system";
  const int full = count_too_small([this](const Writer& writer, const auto& expected, int kib) {
    const SmallDisk disk(folder_.path() / "disk", kib);
    EXPECT_TRUE(disk.is_mounted());
    return is_done_or_reported(writer, "disk", expected);
  });
  EXPECT_GT(full, 12);
}

TEST_F(OutputsOfAllSizes, are_whole_or_absent_where_files_may_not_grow) {
  const int full = count_too_small([this](const Writer& writer, const auto& expected, int kib) {
    fs::create_directory(path("limited"));
    const bool is_done = [&] {
      const ResourceLimit limit(RLIMIT_FSIZE, static_cast<rlim_t>(1024) * static_cast<rlim_t>(kib));
      return is_done_or_reported(writer, "limited", expected);
    }();
    fs::remove_all(path("limited"));
    return is_done;
  });
  EXPECT_GT(full, 10);
}

}  // namespace
}  // namespace talus::test
