/// Repair keeps the intact parts of a damaged run, and nothing else.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "io/run_file.h"
#include "io/run_folder.h"
#include "support/exit_code.h"
#include "support/has.h"
#include "unit/io/damaged_run.h"
#include "unit/io/example_run.h"

namespace talus::io {
namespace {

namespace fs = std::filesystem;

bool mention(const std::vector<std::string>& lines, const std::string& text) {
  return std::ranges::any_of(lines, [&](const std::string& line) { return test::has(line, text); });
}

/// Compares values, with NaN equal to NaN.
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

ExitCode code_of(const RepairRequest& request) {
  return test::exit_code_of([&] { repair_run(request); });
}

/// Packed run of 3 frames and 10 rows of steps, intact and damaged.
class RepairFile : public testing::Test {
 protected:
  RepairFile() {
    RunStore store = RunStore::create(good_, example::header(), false);
    for (int k = 1; k < 3; ++k) store.commit(example::segment(k), example::checkpoint(k));
    store.pack();
    fs::copy_file(good_, bad_);
  }

  RepairReport repair() { return repair_run({bad_, out_, false}); }

  example::TemporaryFolder folder_;
  std::string good_ = folder_.path("good.h5"), bad_ = folder_.path("bad.h5"), out_ = folder_.path("out.h5");
};

TEST_F(RepairFile, keeps_all_frames_but_the_damaged_one) {
  example::spoil_data_set(bad_, "/particles/grains/velocity/value", 1);
  const std::string before = test::text_of(bad_);
  const RepairReport report = repair();
  EXPECT_EQ(test::text_of(bad_), before);
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

TEST_F(RepairFile, leaves_out_a_table_of_which_a_column_is_damaged) {
  for (const char* column : {"/steps/residual", "/steps/step"}) {
    fs::copy_file(good_, bad_, fs::copy_options::overwrite_existing);
    example::spoil_data_set(bad_, column);
    const RepairReport report = repair_run({bad_, out_, true});
    EXPECT_TRUE(mention(report.kept, "0 steps"));
    EXPECT_TRUE(mention(report.lost,
                        std::string(column) + ": is not as it was written, so all of /steps is left out"));
    const RunFile good = RunFile::open(good_), run = RunFile::open(out_);
    EXPECT_TRUE(run.steps().empty());
    EXPECT_EQ(run.all_observables(), good.all_observables());
    EXPECT_EQ(run.all_frame_tilts(), good.all_frame_tilts());
  }
}

TEST_F(RepairFile, leaves_out_a_fact_of_the_provenance_alone) {
  example::spoil_data_set(bad_, "/provenance/author");
  const RepairReport report = repair();
  EXPECT_EQ(report.lost, std::vector<std::string>{"/provenance/author: is not as it was written"});
  const RunFile run = RunFile::open(out_);
  EXPECT_FALSE(find_value(run.header().provenance, "author"));
  EXPECT_EQ(find_value(run.header().provenance, "version"), "0.1.0");
}

TEST_F(RepairFile, sees_what_was_changed_before_the_file_was_sealed_again) {
  for (const char* data_set :
       {"/provenance/author", "/results/theta_c", "/checkpoint/vx", "/frames/time", "/contents"}) {
    fs::copy_file(good_, bad_, fs::copy_options::overwrite_existing);
    example::spoil_data_set(bad_, data_set);
    example::seal_again(bad_);
    EXPECT_FALSE(repair_run({bad_, out_, true}).was_whole) << data_set;
    EXPECT_TRUE(damaged_pieces(out_).empty()) << data_set;
  }
}

TEST_F(RepairFile, without_its_contents_keeps_frames_and_series) {
  example::spoil_data_set(bad_, "/contents");
  EXPECT_TRUE(mention(repair().lost, "/contents: is not as it was written"));
  const RunFile good = RunFile::open(good_), run = RunFile::open(out_);
  EXPECT_EQ(run.all_frame_tilts(), good.all_frame_tilts());
  EXPECT_EQ(run.steps(), good.steps());
  EXPECT_FALSE(run.has_state());
}

TEST_F(RepairFile, sees_two_data_sets_that_have_changed_places) {
  example::swap_data_sets(bad_, "/checkpoint/vx", "/checkpoint/vy");
  const RepairReport report = repair();
  EXPECT_TRUE(
      mention(report.lost, "/checkpoint/vx: is not as it was written, so all of /checkpoint is left out"));
  EXPECT_TRUE(mention(report.lost, "/checkpoint/vy: "));
}

TEST_F(RepairFile, keeps_the_rest_without_the_last_state) {
  example::spoil_data_set(bad_, "/checkpoint/vx");
  EXPECT_TRUE(mention(repair().lost, "/checkpoint/vx: is not as it was written"));
  const RunFile run = RunFile::open(out_);
  EXPECT_FALSE(run.has_state());
  EXPECT_EQ(run.all_frame_tilts().size(), 3U);
  EXPECT_EQ(run.checkpoint().results.size(), 3U);
  EXPECT_NO_THROW(run.frame(2));
}

TEST_F(RepairFile, keeps_nothing_without_the_statics) {
  example::spoil_data_set(bad_, "/particles/grains/radius");
  EXPECT_TRUE(test::refuses(
      [&] {
        repair_run({bad_, out_, false});
      },
      ExitCode::bad_data, {"nothing can be saved: /particles/grains/radius: is not as it was written"}));
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(RepairFile, reads_past_a_cut_and_a_lost_seal) {
  std::string text = test::text_of(good_);
  example::write_text(bad_, text.substr(0, text.size() - 2000));
  EXPECT_FALSE(repair().was_whole);
  EXPECT_EQ(RunFile::open(out_).all_frame_tilts().size(), 3U);
  std::fill_n(text.begin(), 512, '\0');
  example::write_text(bad_, text);
  EXPECT_TRUE(repair_run({bad_, out_, true}).lost.empty());
  EXPECT_EQ(RunFile::open(out_).lost(), "");
}

TEST_F(RepairFile, of_another_version_is_refused) {
  std::string text = test::text_of(bad_);
  text[100] = 'x';  // damages the seal
  example::write_text(bad_, text);
  EXPECT_TRUE(damaged_pieces(bad_).empty());
  example::set_version(bad_, 3);
  EXPECT_TRUE(test::refuses(
      [&] {
        repair_run({bad_, out_, false});
      },
      ExitCode::bad_data, {"schema_version is 3, expected 4"}));
}

TEST_F(RepairFile, replaces_nothing_unasked) {
  example::spoil_data_set(bad_, "/steps/residual");
  example::write_text(out_, "mine");
  EXPECT_EQ(code_of({bad_, out_, false}), ExitCode::cannot_create);
  EXPECT_EQ(test::text_of(out_), "mine");
  EXPECT_EQ(code_of({bad_, out_, true}), ExitCode::done);
  EXPECT_EQ(code_of({bad_, bad_, true}), ExitCode::usage);
  EXPECT_EQ(code_of({folder_.path("none.h5"), out_, true}), ExitCode::missing_input);
}

/// Run of four commits of 5 steps each, still in its folder.
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
  std::string file(const std::string& name) { return test::path_beginning(run_folder(run_), name); }
  std::string name_of(const std::string& name) { return fs::path(file(name)).filename().string(); }
  void break_file(const std::string& name) {
    const std::string text = test::text_of(file(name));
    example::write_text(file(name), text.substr(0, text.size() / 4));
  }
  RepairReport repair() { return repair_run({run_, out_, false}); }
  /// Expects exactly the frames of these commits.
  void expect_frames_of(const std::vector<int>& commits) {
    const RunFile run = RunFile::open(out_);
    EXPECT_TRUE(run.complete());
    std::size_t number = 0;
    for (const int k : commits)
      for (const Frame& frame : segment(k).frames) {
        ASSERT_LT(number, run.all_frame_tilts().size());
        EXPECT_TRUE(same(run.frame(number++), as_stored(frame)));
      }
    EXPECT_EQ(run.all_frame_tilts().size(), number);
    EXPECT_EQ(run.steps().size(), 5U * commits.size());
  }

  example::TemporaryFolder folder_;
  std::string run_ = folder_.path("run.h5"), out_ = folder_.path("out.h5");
};

TEST_F(RepairFolder, that_is_whole_is_left_alone) {
  const RepairReport report = repair();
  EXPECT_TRUE(report.was_whole && report.of_folder);
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(RepairFolder, keeps_the_frames_without_the_last_state) {
  break_file("checkpoint_000004");
  EXPECT_TRUE(mention(repair().lost, name_of("checkpoint_000004") + ": "));
  expect_frames_of({0, 1, 2, 3});
  EXPECT_FALSE(RunFile::open(out_).has_state());
}

TEST_F(RepairFolder, needs_no_manifest) {
  for (const char* text : {"", "talus run folder 1\nheader"}) {
    example::write_text(file(Manifest::file_name), text);
    EXPECT_EQ(repair_run({run_, out_, true}).lost,
              std::vector<std::string>{"manifest: is not as it was written"});
    expect_frames_of({0, 1, 2, 3});
    EXPECT_EQ(state_hash(RunFile::open(out_).checkpoint().world), state_hash(checkpoint(3).world));
  }
  fs::remove(file(Manifest::file_name));
  repair_run({run_, out_, true});
  expect_frames_of({0, 1, 2, 3});
}

TEST_F(RepairFolder, keeps_the_frames_beside_a_missing_segment) {
  const std::string name = name_of("segment_000003");
  fs::remove(file(name));
  EXPECT_TRUE(mention(repair().lost, name + ": is missing"));
  expect_frames_of({0, 1, 3});
}

TEST_F(RepairFolder, waits_for_the_process_that_writes_it) {
  RunHeader header;
  Checkpoint state;
  const RunStore store = RunStore::resume(run_, header, state);
  break_file("checkpoint_000004");
  EXPECT_EQ(code_of({run_, out_, false}), ExitCode::cannot_create);
}

TEST_F(RepairFolder, keeps_the_frames_beside_a_broken_segment) {
  break_file("segment_000002");
  repair();
  expect_frames_of({0, 2, 3});
  EXPECT_TRUE(test::has(RunFile::open(out_).lost(), name_of("segment_000002")));
}

TEST_F(RepairFolder, keeps_the_frames_beside_a_damaged_one) {
  example::spoil_data_set(file("segment_000003"), "/particles/grains/angle/value", 1);
  EXPECT_TRUE(mention(repair().lost, name_of("segment_000003") + ": frame 1, at 1.750 deg"));
  EXPECT_EQ(RunFile::open(out_).all_frame_tilts().size(), 2U);  // frames of commits 1 and 2
}

TEST_F(RepairFolder, without_its_header_is_refused) {
  break_file("header_");
  EXPECT_EQ(code_of({run_, out_, false}), ExitCode::bad_data);
  EXPECT_FALSE(fs::exists(out_) || fs::exists(run_folder(out_)));
}

}  // namespace
}  // namespace talus::io
