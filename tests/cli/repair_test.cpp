/// `talus repair`, and the report of `talus check` on a damaged run.

#include <gtest/gtest.h>

#include <algorithm>

#include "io/run_file.h"
#include "session/run.h"
#include "session/run_header.h"
#include "support/commands.h"
#include "support/small_bed.h"
#include "unit/io/damaged_run.h"

namespace talus::test {
namespace {

namespace fs = std::filesystem;

class Repair : public CommandTest {
 protected:
  static scenario::Scenario bed() { return small_tilted_bed(2.0); }

  /// Computes a run of 5 frames, completely or up to the third frame.
  void compute(const std::string& name, bool to_its_end) {
    session::Session session(bed());
    io::RunStore store = io::RunStore::create(
        folder_.path(name), session::run_header(session, {scenario::resolved_toml(bed()), "", "", 1}), false);
    std::size_t frames = 0;
    volatile std::sig_atomic_t stop = 0;
    session::RunControl control;
    control.stop = &stop;
    control.on_frame = [&](const Frame&) { stop = ++frames == 3 && !to_its_end ? 1 : 0; };
    session::run_to_end(session, store, control);
  }

  void cut_in_half(const std::string& path) { fs::resize_file(path, fs::file_size(path) / 2); }
  std::string last_file(const std::string& folder, const std::string& kind) {
    std::string last;
    for (const auto& entry : fs::directory_iterator(folder_.path() / folder))
      if (const std::string name = entry.path().filename(); name.starts_with(kind))
        last = std::max(last, entry.path().string());
    return last;
  }
};

TEST_F(Repair, check_tells_of_a_value_that_was_changed_before_the_file_was_sealed_again) {
  compute("bed.h5", true);
  example::spoil_data_set(folder_.path("bed.h5"), "/results/residual_max");
  example::seal_again(folder_.path("bed.h5"));
  const Outcome check = talus({"check", "bed.h5"});
  EXPECT_TRUE(ends(check, 65, {"bed.h5 is damaged: /results/residual_max: is not as it was written"}));
  EXPECT_TRUE(has(check.out, "hashes      wrong for 1 of the data sets and frames\n"));
  EXPECT_TRUE(has(talus({"repair", "bed.h5", "-o", "new.h5"}).out,
                  "/results/residual_max: is not as it was written"));
  EXPECT_EQ(talus({"check", "new.h5"}).exit_code, 0);
}

TEST_F(Repair, says_that_a_whole_run_is_whole) {
  compute("bed.h5", true);
  const Outcome repair = talus({"repair", "bed.h5", "-o", "new.h5"});
  EXPECT_EQ(repair.exit_code, 0) << repair.err;
  EXPECT_EQ(repair.out, "bed.h5 is intact: nothing to repair, and nothing was written\n");
  EXPECT_FALSE(folder_.has_file("new.h5"));
}

TEST_F(Repair, of_a_file_keeps_its_whole_frames_and_every_command_reads_them) {
  compute("bed.h5", true);
  EXPECT_EQ(talus({"analyze", "bed.h5"}).exit_code, 0);
  example::spoil_data_set(folder_.path("bed.h5"), "/particles/grains/position/value", 2);
  const Outcome check = talus({"check", "bed.h5"});
  EXPECT_TRUE(ends(check, 65, {"save what is undamaged with: talus repair bed.h5 -o NEW.h5"}));
  EXPECT_EQ(check.out, "bed.h5: damaged\n  fault: frame 2, at 1.000 deg\n");
  EXPECT_TRUE(has(talus({"check", "bed.h5", "--json"}).out, "\"faults\": [\"frame 2, at 1.000 deg\"]"));

  EXPECT_TRUE(ends(talus({"repair", "bed.h5", "-o", "new.h5"}), 0,
                   {"  kept  4 of 5 frames\n", "  lost  frame 2, at 1.000 deg\n",
                    "  lost  /analysis: is not part of the run; recompute it with talus analyze\n"}));
  EXPECT_EQ(talus({"check", "new.h5"}).exit_code, 0) << talus({"check", "new.h5"}).out;
  EXPECT_TRUE(has(talus({"info", "new.h5"}).out, "frame 2, at 1.000 deg (the run was repaired)"));
  EXPECT_EQ(talus({"analyze", "new.h5"}).exit_code, 0) << talus({"analyze", "new.h5"}).err;
  EXPECT_EQ(talus({"check", "new.h5"}).exit_code, 0) << "with its analysis";
  EXPECT_EQ(talus({"replay", "new.h5"}).exit_code, 0);
  EXPECT_EQ(talus({"repair", "bed.h5", "-o", "new.h5"}).exit_code, 73);
  EXPECT_EQ(talus({"repair", "bed.h5", "-o", "new.h5", "--overwrite"}).exit_code, 0);
}

TEST_F(Repair, without_its_last_state_a_run_is_still_read) {
  compute("bed.h5", true);
  example::spoil_data_set(folder_.path("bed.h5"), "/checkpoint/x");
  example::spoil_data_set(folder_.path("bed.h5"), "/steps/step");
  example::spoil_data_set(folder_.path("bed.h5"), "/observables/at_rest");
  EXPECT_EQ(talus({"repair", "bed.h5", "-o", "new.h5"}).exit_code, 0);
  EXPECT_EQ(talus({"check", "new.h5"}).exit_code, 0) << talus({"check", "new.h5"}).out;
  EXPECT_EQ(folder_.hash("new.h5"), "none");
  EXPECT_TRUE(ends(talus({"analyze", "new.h5"}), 0));
  for (const Words& needs_it :
       {Words{"replay", "new.h5"}, {"dump", "new.h5", "--at", "frame1", "-o", "problem.h5"}})
    EXPECT_TRUE(ends(talus(needs_it), 65, {"its last state is lost"}));
}

TEST_F(Repair, of_a_folder_keeps_the_frames_and_its_scenario_computes_the_rest_again) {
  compute("whole.h5", true);
  for (const char* kind : {"checkpoint_", "segment_", "manifest"}) {
    const std::string name = std::string(kind) + ".h5", fixed = "fixed-" + name;
    compute(name, false);
    cut_in_half(last_file(name + ".run", kind));
    EXPECT_EQ(talus({"check", name}).exit_code, 65);
    EXPECT_TRUE(ends(talus({"repair", name, "-o", fixed}), 0));
    EXPECT_EQ(talus({"check", fixed}).exit_code, 0) << talus({"check", fixed}).out;
    const io::RunFile whole = io::RunFile::open(folder_.path("whole.h5")),
                      run = io::RunFile::open(folder_.path(fixed));
    EXPECT_GE(run.all_frame_tilts().size(), 2U);
    for (std::size_t k = 0; k < run.all_frame_tilts().size(); ++k)
      EXPECT_EQ(run.frame(k).x, whole.frame(k).x);
    EXPECT_EQ(run.header().scenario_resolved, whole.header().scenario_resolved);
  }
}

TEST_F(Repair, of_a_folder_with_a_gap_packs_the_frames) {
  compute("bed.h5", false);
  const fs::path segment = path_beginning(folder_.path() / "bed.h5.run", "segment_000002");
  ASSERT_TRUE(fs::remove(segment));
  EXPECT_TRUE(ends(talus({"repair", "bed.h5", "-o", "new.h5"}), 0,
                   {"  lost  " + segment.filename().string() + ": is missing\n", "it cannot be continued"}));
  EXPECT_EQ(talus({"check", "new.h5"}).exit_code, 0) << talus({"check", "new.h5"}).out;
}

}  // namespace
}  // namespace talus::test
