/// What is whole of a damaged run is kept, and nothing else.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "io/manifest.h"
#include "io/run_repair.h"
#include "unit/io/damaged_run.h"
#include "unit/io/example_run.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

bool mention(const std::vector<std::string>& lines, const std::string& text) {
  return std::ranges::any_of(lines,
                             [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

/// Equal values, one without a value equal to another.
bool same(const std::vector<double>& one, const std::vector<double>& other) {
  return std::ranges::equal(one, other,
                            [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); });
}

bool same(const Frame& one, const Frame& other) {
  const FrameContacts &a = one.contacts, &b = other.contacts;
  return one.step == other.step && one.tilt == other.tilt && same(one.x, other.x) && same(one.y, other.y) &&
         same(one.angle, other.angle) && same(one.vx, other.vx) && same(one.vy, other.vy) &&
         same(one.omega, other.omega) && same(one.gamma, other.gamma) && one.image == other.image &&
         a.a == b.a && a.b == b.b && a.shift == b.shift && a.status == b.status && same(a.nx, b.nx) &&
         same(a.px, b.px) && same(a.fn, b.fn) && same(a.ft, b.ft);
}

ExitCode code_of(const RepairRequest& request, std::string* message = nullptr) {
  try {
    repair_run(request);
  } catch (const Error& error) {
    if (message != nullptr) *message = error.what();
    return error.code();
  }
  return ExitCode::done;
}

/// A packed run of 3 frames and 10 rows of steps, whole and damaged.
class RepairFile : public testing::Test {
 protected:
  RepairFile() {
    RunStore store = RunStore::create(good_, example::header(), false);
    for (int k = 1; k < 3; ++k) store.commit(example::segment(k), example::checkpoint(k));
    store.pack();
    fs::copy_file(good_, bad_);
  }

  RepairReport repair() { return repair_run({bad_, out_, false, {}}); }

  example::TemporaryFolder folder_;
  std::string good_ = folder_.path("good.h5"), bad_ = folder_.path("bad.h5"), out_ = folder_.path("out.h5");
};

TEST_F(RepairFile, that_is_whole_is_left_alone) {
  EXPECT_TRUE(damaged_pieces(good_).empty());
  EXPECT_TRUE(repair().was_whole);
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(RepairFile, keeps_all_frames_but_the_damaged_one) {
  example::spoil_data_set(bad_, "/particles/grains/velocity/value", 1);
  const std::string before = example::file_text(bad_);
  const RepairReport report = repair();
  EXPECT_EQ(example::file_text(bad_), before);
  EXPECT_TRUE(report.verified);
  EXPECT_TRUE(mention(report.kept, "2 of 3 frames"));
  EXPECT_TRUE(mention(report.lost, "frame 1, at 1.500 deg"));
  const RunFile good = RunFile::open(good_), run = RunFile::open(out_);
  ASSERT_EQ(run.all_frame_tilts().size(), 2U);
  EXPECT_TRUE(same(run.frame(0), good.frame(0)));
  EXPECT_TRUE(same(run.frame(1), good.frame(2)));
  EXPECT_EQ(run.steps(), good.steps());
  EXPECT_EQ(run.all_observables(), good.all_observables());
  EXPECT_EQ(run.commands().size(), good.commands().size());
  EXPECT_EQ(state_hash(run.checkpoint().world), state_hash(good.checkpoint().world));
  EXPECT_EQ(run.lost(), "frame 1, at 1.500 deg");
  EXPECT_EQ(find_value(run.header().provenance, "repaired_from"), bad_);
  EXPECT_TRUE(damaged_pieces(out_).empty());
}

TEST_F(RepairFile, sees_a_value_that_is_another_and_could_be) {
  example::spoil_data_set(bad_, "/frames/time");  // of frame 0: a finite number
  EXPECT_EQ(damaged_pieces(bad_).size(), 1U);
  repair();
  EXPECT_EQ(RunFile::open(out_).all_frame_tilts().size(), 2U);
}

TEST_F(RepairFile, keeps_the_other_columns_of_a_table) {
  example::spoil_data_set(bad_, "/steps/residual");
  EXPECT_TRUE(mention(repair().lost, "/steps/residual: "));
  const RunFile good = RunFile::open(good_), run = RunFile::open(out_);
  ASSERT_EQ(run.steps().size(), good.steps().size());
  EXPECT_TRUE(std::isnan(at(run.steps()[3], StepField::residual)));
  EXPECT_EQ(at(run.steps()[3], StepField::contacts), at(good.steps()[3], StepField::contacts));
}

TEST_F(RepairFile, sees_two_data_sets_that_have_changed_places) {
  example::swap_data_sets(bad_, "/checkpoint/vx", "/checkpoint/vy");
  const RepairReport report = repair();
  EXPECT_TRUE(mention(report.lost, "/checkpoint: /checkpoint/vx is not as it was written"));
}

TEST_F(RepairFile, leaves_out_a_table_without_its_steps) {
  example::spoil_data_set(bad_, "/observables/step");
  EXPECT_TRUE(mention(repair().lost, "/observables: "));
  EXPECT_TRUE(RunFile::open(out_).all_observables().empty());
  EXPECT_EQ(RunFile::open(out_).steps().size(), 10U);
}

TEST_F(RepairFile, keeps_the_rest_without_the_last_state) {
  example::spoil_data_set(bad_, "/checkpoint/vx");
  EXPECT_TRUE(mention(repair().lost, "/checkpoint: /checkpoint/vx is not as it was written"));
  const RunFile run = RunFile::open(out_);
  EXPECT_FALSE(run.has_state());
  EXPECT_EQ(run.all_frame_tilts().size(), 3U);
  EXPECT_EQ(run.checkpoint().results.size(), 3U);
  EXPECT_NO_THROW(run.frame(2));
}

TEST_F(RepairFile, keeps_nothing_without_the_statics) {
  example::spoil_data_set(bad_, "/particles/grains/radius");
  std::string message;
  EXPECT_EQ(code_of({bad_, out_, false, {}}, &message), ExitCode::bad_data);
  EXPECT_NE(message.find("nothing can be kept: data set /particles/grains/radius is lost"), std::string::npos)
      << message;
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(RepairFile, reads_past_a_cut_and_a_lost_seal) {
  std::string text = example::file_text(good_);
  example::write_text(bad_, text.substr(0, text.size() - 2000));
  EXPECT_FALSE(repair().was_whole);
  EXPECT_EQ(RunFile::open(out_).all_frame_tilts().size(), 3U);
  std::fill_n(text.begin(), 512, '\0');
  example::write_text(bad_, text);
  EXPECT_TRUE(repair_run({bad_, out_, true, {}}).lost.empty());
  EXPECT_EQ(RunFile::open(out_).lost(), "");
}

TEST_F(RepairFile, of_before_there_were_hashes_is_said_to_be_unverified) {
  example::make_of_version_2(bad_);
  EXPECT_EQ(RunFile::open(bad_).all_frame_tilts().size(), 3U);
  EXPECT_TRUE(damaged_pieces(bad_).empty());
  std::string text = example::file_text(bad_);
  text[100] = 'x';  // the seal
  example::write_text(bad_, text);
  example::spoil_data_set(bad_, "/particles/grains/gamma/value", 0);
  const RepairReport report = repair_run({bad_, out_, false, [](const RunFile& run) {
                                            EXPECT_EQ(run.all_frame_tilts().size(), 2U);
                                            return std::vector<std::size_t>{1};
                                          }});
  EXPECT_FALSE(report.verified);
  EXPECT_TRUE(mention(report.lost, "frame 0, at 0.750 deg"));
  EXPECT_TRUE(mention(report.lost, "frame 2, at 1.750 deg"));
  const RunFile good = RunFile::open(good_), run = RunFile::open(out_);
  ASSERT_EQ(run.all_frame_tilts().size(), 1U);
  EXPECT_TRUE(same(run.frame(0), good.frame(1)));
}

TEST_F(RepairFile, of_a_version_that_is_not_known_is_refused) {
  example::make_of_version_2(bad_);
  example::set_version(bad_, 9);
  std::string message;
  EXPECT_EQ(code_of({bad_, out_, false, {}}, &message), ExitCode::bad_data);
  EXPECT_NE(message.find("schema_version is 9, this Talus reads versions 1 to 3"), std::string::npos)
      << message;
}

TEST_F(RepairFile, replaces_nothing_unasked) {
  example::spoil_data_set(bad_, "/steps/residual");
  example::write_text(out_, "mine");
  EXPECT_EQ(code_of({bad_, out_, false, {}}), ExitCode::cannot_create);
  EXPECT_EQ(example::file_text(out_), "mine");
  EXPECT_EQ(code_of({bad_, out_, true, {}}), ExitCode::done);
  EXPECT_EQ(code_of({bad_, bad_, true, {}}), ExitCode::usage);
  EXPECT_EQ(code_of({folder_.path("none.h5"), out_, true, {}}), ExitCode::missing_input);
}

/// A run of four commits of 5 steps each, still in its folder.
class RepairFolder : public testing::Test {
 protected:
  RepairFolder() {
    RunStore store = RunStore::create(run_, example::header(), false);
    for (int k = 0; k < 4; ++k) store.commit(segment(k), checkpoint(k));
  }

  static Segment segment(int k) {
    Segment s = example::segment(k);
    for (std::size_t i = 0; i < s.steps.size(); ++i)
      at(s.steps[i], StepField::step) = 5.0 * k + static_cast<double>(i) + 1.0;
    return s;
  }
  static Checkpoint checkpoint(int k) {
    Checkpoint c = example::checkpoint(k);
    c.world.step = 5 * (k + 1);
    return c;
  }
  std::string file(const std::string& name) { return run_folder(run_) + "/" + name; }
  void break_file(const std::string& name) {
    const std::string text = example::file_text(file(name));
    example::write_text(file(name), text.substr(0, text.size() / 4));
  }
  RepairReport repair() { return repair_run({run_, out_, false, {}}); }
  void expect_goes_on_after(int commits) {
    RunHeader header;
    Checkpoint state;
    const RunStore store = RunStore::resume(out_, header, state);
    EXPECT_EQ(state_hash(state.world), state_hash(checkpoint(commits - 1).world));
    EXPECT_EQ(state.integers, checkpoint(commits - 1).integers);
    const RunFile run = RunFile::open(out_);
    EXPECT_EQ(run.steps().size(), 5U * static_cast<std::size_t>(commits));
    std::size_t number = 0;
    for (int k = 0; k < commits; ++k)
      for (const Frame& frame : segment(k).frames) EXPECT_TRUE(same(run.frame(number++), as_stored(frame)));
    EXPECT_EQ(run.all_frame_tilts().size(), number);
    EXPECT_EQ(run.lost(), "");
  }

  example::TemporaryFolder folder_;
  std::string run_ = folder_.path("run.h5"), out_ = folder_.path("out.h5");
};

TEST_F(RepairFolder, keeps_the_checkpoint_of_the_commit_before) {
  EXPECT_TRUE(repair().was_whole);
  EXPECT_TRUE(fs::exists(file("checkpoint_000003.h5")));
  EXPECT_FALSE(fs::exists(file("checkpoint_000002.h5")));
  break_file("checkpoint_000003.h5");
  EXPECT_TRUE(repair().was_whole);  // it is no part of the run
}

TEST_F(RepairFolder, goes_on_from_the_commit_before_a_broken_state) {
  break_file("checkpoint_000004.h5");
  const RepairReport report = repair();
  EXPECT_TRUE(report.goes_on);
  EXPECT_TRUE(mention(report.lost, "checkpoint_000004.h5"));
  expect_goes_on_after(3);
}

TEST_F(RepairFolder, goes_on_from_the_commit_before_a_broken_segment) {
  fs::remove(file("segment_000004.h5"));
  EXPECT_TRUE(repair().goes_on);
  expect_goes_on_after(3);
}

TEST_F(RepairFolder, makes_the_manifest_again) {
  for (const char* text : {"", "talus run folder 1\nheader"}) {
    example::write_text(file(Manifest::file_name), text);
    EXPECT_TRUE(repair_run({run_, out_, true, {}}).goes_on);
    expect_goes_on_after(4);
  }
  fs::remove(file(Manifest::file_name));
  EXPECT_TRUE(repair_run({run_, out_, true, {}}).goes_on);
  expect_goes_on_after(4);
}

TEST_F(RepairFolder, goes_on_over_no_gap_that_no_manifest_tells_of) {
  fs::remove(file(Manifest::file_name));
  fs::remove(file("segment_000002.h5"));
  EXPECT_FALSE(repair().goes_on);
}

TEST_F(RepairFolder, waits_for_the_process_that_writes_it) {
  RunHeader header;
  Checkpoint state;
  const RunStore store = RunStore::resume(run_, header, state);
  break_file("checkpoint_000004.h5");
  EXPECT_EQ(code_of({run_, out_, false, {}}), ExitCode::cannot_create);
}

TEST_F(RepairFolder, of_a_run_with_a_gap_is_packed) {
  break_file("segment_000002.h5");
  const RepairReport report = repair();
  EXPECT_FALSE(report.goes_on);
  const RunFile run = RunFile::open(out_);
  EXPECT_TRUE(run.complete());
  EXPECT_EQ(run.steps().size(), 15U);
  ASSERT_EQ(run.all_frame_tilts().size(), 2U);  // of commit 2, counted from 0
  EXPECT_TRUE(same(run.frame(0), as_stored(segment(2).frames[0])));
  EXPECT_NE(run.lost().find("segment_000002.h5"), std::string::npos) << run.lost();
}

TEST_F(RepairFolder, goes_on_over_no_damaged_frame) {
  example::spoil_data_set(file("segment_000003.h5"), "/particles/grains/angle/value", 1);
  EXPECT_FALSE(repair().goes_on);
  EXPECT_EQ(RunFile::open(out_).all_frame_tilts().size(), 2U);  // of commits 1 and 2
}

TEST_F(RepairFolder, without_its_header_is_refused) {
  break_file("header.h5");
  EXPECT_EQ(code_of({run_, out_, false, {}}), ExitCode::bad_data);
  EXPECT_FALSE(fs::exists(out_) || fs::exists(run_folder(out_)));
}

}  // namespace
}  // namespace talus
