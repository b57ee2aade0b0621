/// Runs with random damage: repaired data equal the original and pass every check.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

#include "base/errors.h"
#include "core/random.h"
#include "io/run_file.h"
#include "reliability/hostile_run.h"
#include "reliability/hostile_test.h"
#include "reliability/whole_run.h"
#include "session/run_check.h"

namespace talus::hostile {
namespace {

namespace fs = std::filesystem;

constexpr std::array damage_names = {"a byte flipped", "up to 4 KiB of zeros", "cut"};

/// Amounts of data kept over many repairs.
struct Count {
  int repaired = 0, refused = 0, harmless = 0;
  std::size_t frames = 0, kept = 0;

  void print(const std::string& name) const {
    std::printf("%s: %d repaired, %d refused, %d harmless; %zu of %zu frames kept\n", name.c_str(), repaired,
                refused, harmless, kept, frames);
  }
};

class RepairOfChance : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = new test::CommandFolder;
    make_run(folder->path("good.h5"));
    make_folder_of_run(folder->path("left.h5"), 0.7);
    const io::RunFile run = io::RunFile::open(folder->path("good.h5"));
    for (std::size_t k = 0; k < run.all_frame_tilts().size(); ++k)
      frame_of.emplace(run.frame(k).step, test::frame_digest(run.frame(k)));
  }
  static void TearDownTestSuite() {
    delete folder;
    folder = nullptr;
  }

  /// Repairs a run and compares the result with the intact one.
  static void check_repair(const std::string& path, std::size_t frames, Count& count) {
    const std::string out = folder->path("out.h5");
    count.frames += frames;
    io::RepairReport report;
    try {
      report = io::repair_run({path, out, true});
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::bad_data) << error.what();
      ++count.refused;
      return;
    }
    count.harmless += report.was_whole ? 1 : 0;
    count.repaired += report.was_whole ? 0 : 1;
    const io::RunFile run = io::RunFile::open(report.was_whole ? path : out);
    for (std::size_t k = 0; k < run.all_frame_tilts().size(); ++k) {
      const Frame frame = run.frame(k);
      EXPECT_EQ(frame_of.at(frame.step), test::frame_digest(frame)) << "frame " << k;
      ++count.kept;
    }
    const session::RunCheck check = session::check_run(run, {});
    EXPECT_TRUE(check.faults.empty()) << check.faults.front();
    EXPECT_TRUE(io::damaged_pieces(report.was_whole ? path : out).empty());
  }

  static inline test::CommandFolder* folder = nullptr;
  static inline std::map<std::int64_t, std::string> frame_of;  ///< digest by step
};

TEST_F(RepairOfChance, of_a_packed_file) {
  const Bytes good = read_bytes(folder->path("good.h5"));
  const std::string bad = folder->path("bad.h5");
  Random random(40);
  for (const Damage kind : damages) {
    Count count;
    for (int k = 0; k < tries(8) && !HasFailure(); ++k) {
      Bytes bytes = good;
      damage(bytes, kind, random);
      write_bytes(bad, bytes);
      SCOPED_TRACE("try " + std::to_string(k));
      check_repair(bad, frame_of.size(), count);
    }
    count.print(std::string("packed file of ").append(std::to_string(good.size() / 1024)).append(" KiB, ") +
                damage_names[static_cast<std::size_t>(kind)]);
    EXPECT_GT(count.kept, count.frames / 4);
  }
}

TEST_F(RepairOfChance, of_each_file_of_a_folder) {
  const std::string run = folder->path("left.h5");
  const std::size_t frames = io::RunFile::open(run).all_frame_tilts().size();
  Random random(50);
  for (const auto& entry : fs::directory_iterator(io::run_folder(run))) {
    if (entry.path().filename() == "lock") continue;
    const Bytes whole = read_bytes(entry.path());
    Count count;
    for (int k = 0; k < std::max(3, tries(0) / 10) && !HasFailure(); ++k) {
      Bytes bytes = whole;
      damage(bytes, damages[static_cast<std::size_t>(k) % damages.size()], random);
      write_bytes(entry.path(), bytes);
      SCOPED_TRACE(entry.path().filename().string() + ", try " + std::to_string(k));
      check_repair(run, frames, count);
    }
    write_bytes(entry.path(), whole);
    count.print(entry.path().filename());
  }
}

}  // namespace
}  // namespace talus::hostile
