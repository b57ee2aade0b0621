#pragma once
/// All commands that write a file or a folder, and the places in which they are tested.

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "io/run_file.h"
#include "reliability/whole_run.h"
#include "support/runs.h"

namespace talus::test {
namespace fs = std::filesystem;

constexpr int done = 0, usage = 64, refused = 73, io_error = 74;
constexpr int block = 4;          // KiB, block of a file system
constexpr int ample = 64 * 1024;  // KiB

/// Command that writes, with "OUT" as the output among its words. Its inputs are in the parent folder.
struct Writer {
  std::string name;
  std::string output;  ///< name in the folder of outputs
  Words words;
  bool of_folder = false;  ///< whether the output is a folder
  bool is_movie = false;
};

inline bool decodes(const fs::path& movie) {
  ::setenv("MOVIE", movie.c_str(), 1);  // a name may contain quotes
  return std::system("ffmpeg -nostdin -v error -xerror -i \"file:$MOVIE\" -f null -") == 0;
}

/// Returns whether a file ends as its format requires. Files written through memory can only be torn at the
/// end.
inline bool has_end_of_format(const fs::path& file) {
  const std::string ending = file.extension().string(), bytes = text_of(file);
  if (ending == ".png") return bytes.ends_with("IEND\xAE\x42\x60\x82");
  if (ending == ".gif") return bytes.ends_with(";");
  if (ending == ".pdf") return bytes.ends_with("%%EOF\n");
  if (ending == ".svg")
    return bytes.find("</svg>", bytes.size() < 16 ? 0 : bytes.size() - 16) != std::string::npos;
  return (ending != ".mp4" && ending != ".webm") || decodes(file);
}

inline Words with_output(Words words, const std::string& output) {
  std::ranges::replace(words, std::string("OUT"), output);
  return words;
}

inline const std::vector<Writer>& writers() {
  static const Words movie = {"animate", "f.h5", "-q", "--map", "pressure", "--size", "300", "-o", "OUT"};
  static const std::vector<Writer> all = {
      {"run", "r.h5", {"run", "bed.toml", "-q", "-o", "OUT"}},
      {"replay", "r.h5", {"replay", "f.h5", "-q", "-o", "OUT"}},
      {"repair", "r.h5", {"repair", "damaged.h5", "-o", "OUT"}},
      {"dump", "p.h5", {"dump", "f.h5", "--at", "frame1", "-o", "OUT"}},
      {"solve", "s.h5", {"solve", "p.h5", "-o", "OUT"}},
      {"panel",
       "p.png",
       {"panel", "f.h5", "-q", "--map", "pressure", "--at", "0,1", "--size", "300", "-o", "OUT"}},
      {"screenshot", "v.png", {"view", "f.h5", "--size", "400x300", "--screenshot", "OUT"}},
      {"mp4", "m.mp4", movie, false, true},
      {"webm", "m.webm", movie, false, true},
      {"gif", "m.gif", movie, false, true},
      {"render", "maps", {"render", "f.h5", "-q", "--map", "pressure", "--size", "300", "-o", "OUT"}, true},
      {"figures", "figs", {"figures", "f.h5", "-q", "--only", "fig04", "-o", "OUT"}, true},
  };
  return all;
}

/// Inputs of all writers, created once.
class Outputs : public CommandTest {
 protected:
  static void SetUpTestSuite() {
    inputs_ = std::make_unique<CommandFolder>(tiny_bed);
    take_run(*inputs_, "f.h5", tiny_bed);
    ASSERT_TRUE(ends(inputs_->talus({"analyze", "f.h5", "-q"}), done));
    ASSERT_TRUE(ends(inputs_->talus({"dump", "f.h5", "--at", "frame1", "-o", "p.h5"}), done));
    std::string bytes = inputs_->text("f.h5");
    bytes[100] = '?';  // part of the seal
    write_file(*inputs_, "damaged.h5", bytes);
    // Mounts made here are visible only to this process and its children.
    if (unshare(CLONE_NEWNS) == 0) mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr);
  }
  static void TearDownTestSuite() { inputs_.reset(); }

  Outputs() {
    for (const std::string& name : names_in(inputs_->path()))
      if (name[0] != '.') fs::copy_file(inputs_->path() / name, folder_.path() / name);
  }

  std::string path(const std::string& name) const { return folder_.path(name); }

  /// Expects everything below a folder of outputs to be complete, without temporary files. Remains of an
  /// unfinished run can be resumed, or are absent.
  static void expect_whole(const fs::path& folder) {
    for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator();
         ++entry) {
      const fs::path& file = entry->path();
      const std::string name = file.filename().string();
      EXPECT_EQ(name.find(".part"), std::string::npos) << file << " was left";
      if (name.ends_with(".run")) {
        committed_frames(file.parent_path() / file.stem());
        entry.disable_recursion_pending();
        continue;
      }
      if (entry->is_directory()) continue;
      EXPECT_GT(fs::file_size(file), 0u) << file;
      if (name[0] == 'r' && name.ends_with(".h5")) digest(file);
      EXPECT_TRUE(has_end_of_format(file)) << file;
    }
  }

  /// Runs a writer below `place`, and expects it either to succeed with all of `expected`, or to report that
  /// it could not write. Returns whether it succeeded.
  bool is_done_or_reported(const Writer& writer, const std::string& place,
                           const std::set<std::string>& expected) {
    const Outcome outcome = talus(with_output(writer.words, place + "/" + writer.output));
    EXPECT_TRUE(outcome.exit_code == done || outcome.exit_code == io_error)
        << outcome.exit_code << ": " << outcome.err;
    expect_whole(folder_.path() / place);
    const fs::path made = folder_.path() / place / (writer.of_folder ? writer.output : "");
    const bool is_done = outcome.exit_code == done;
    EXPECT_TRUE(!is_done || names_in(made) == expected);
    EXPECT_TRUE(!is_done || !writer.is_movie || decodes(made / writer.output)) << "ffmpeg rejects it";
    EXPECT_TRUE(is_done || writer.of_folder || !fs::exists(made / writer.output)) << "truncated";
    return is_done;
  }

  /// Returns the files that a writer makes if nothing interferes, and their size in KiB.
  std::pair<std::set<std::string>, int> undisturbed_files(const Writer& writer) {
    fs::create_directory(path("free"));
    const Outcome outcome = talus(with_output(writer.words, "free/" + writer.output));
    EXPECT_EQ(outcome.exit_code, done) << outcome.err;
    const fs::path made = folder_.path() / "free" / (writer.of_folder ? writer.output : "");
    int size = 0;
    for (const auto& entry : fs::directory_iterator(made))
      size += block * static_cast<int>(1 + (entry.file_size() - 1) / (1024 * block));
    std::set<std::string> names = names_in(made);
    fs::remove_all(path("free"));
    return {names, size};
  }

  /// Returns the sizes to try: each block or, in ctest, the smallest, the middle and those around `size`.
  static std::vector<int> sizes_about(int size) {
    std::vector<int> sizes;
    const bool all = tries(0, 1) > 0;
    for (int kib = block; kib <= (all ? ample : size); kib += block)
      if (all || kib == block || kib == size / 2 / block * block || kib == size - block) sizes.push_back(kib);
    return sizes;
  }

  static inline std::unique_ptr<CommandFolder> inputs_;
};

}  // namespace talus::test
