/// Further analyses of a member of a reproduction: missing ones are made, existing ones are kept. Frames that
/// are deleted once their members are done.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/hash.h"
#include "ensemble/member_results.h"
#include "ensemble/member_state.h"
#include "ensemble/member_task.h"
#include "ensemble/worker.h"
#include "io/durable_file.h"
#include "io/packed_file.h"
#include "runs/analysis_parameters.h"
#include "runs/analysis_run.h"
#include "session/run.h"
#include "session/run_header.h"
#include "support/exit_code.h"
#include "support/places.h"
#include "support/recorded_run.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus::ensemble {
namespace {

namespace fs = std::filesystem;

io::RunFile run_of(const Member& member) {
  session::Session session(member.scenario);
  return test::recorded(session, member.path, {}, {"", {}, "", 1});
}

class ReadingsTest : public testing::Test {
 protected:
  /// Returns a member whose run and analysis are complete.
  Member computed(const scenario::Scenario& scenario) const {
    const Member member =
        plan_ensemble({1}, {{"bed", "", scenario}}, folder_.path().string()).members.front();
    fs::create_directories(folder_.path("bed"));
    const io::RunFile run = run_of(member);
    const analysis::Analysis analysis = runs::analyse_run(run, analysis::AnalysisParameters(), 1, {});
    io::store_analysis(member.path, analysis, hash_text(state_hash(run.checkpoint().world)));
    return member;
  }
  static std::vector<io::StoredReading> readings_of(const Member& member) {
    return io::read_readings(io::RunFile::open(member.path));
  }
  test::TemporaryFolder folder_;
};

TEST_F(ReadingsTest, are_made_where_they_are_missing) {
  const Member member = computed(test::small_tilted_bed(1.0));
  complete_readings(member);
  const std::vector<io::StoredReading> before = readings_of(member);
  ASSERT_EQ(before.size(), 12u);
  for (const io::StoredReading& reading : before) {
    EXPECT_EQ(reading.thresholds, 2u);
    EXPECT_EQ(reading.values.size(), 24u);
    EXPECT_EQ(reading.at_most.size(), 24u);
  }
  const std::string state = hash_text(state_hash(io::RunFile::open(member.path).checkpoint().world));
  std::vector<io::StoredReading> changed = before;
  changed[3].key = "of another version";
  changed[4].values[0] = 7.5;  // valid by its key, so it is accepted as it is
  io::store_readings(member.path, changed, state);
  complete_readings(member);
  EXPECT_EQ(readings_of(member)[3].key, before[3].key);
  EXPECT_EQ(readings_of(member)[4].values[0], 7.5);
  io::store_analysis(member.path, *io::read_analysis(member.path), state);
  EXPECT_EQ(readings_of(member).size(), 12u) << "a run that is analysed again keeps them";
  EXPECT_EQ(io::RunFile::open(member.path).changed_data_sets(), std::vector<std::string>());
  const auto written = fs::last_write_time(member.path);
  complete_readings(member);
  EXPECT_EQ(fs::last_write_time(member.path), written) << "nothing is missing";
}

/// Returns the names of the columns, as docs/reproduce.md lists them.
std::vector<std::string> documented_columns() {
  const std::string page = io::read_text(test::source_folder() + "/docs/reproduce.md");
  std::vector<std::string> names;
  for (std::size_t at = page.find("one column for each of");
       (at = page.find('`', at)) != std::string::npos;) {
    const std::size_t end = page.find('`', at + 1);
    names.push_back(page.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  return names;
}

TEST_F(ReadingsTest, have_the_numbers_of_an_analysis_in_the_order_of_the_document) {
  scenario::Scenario scenario = test::small_tilted_bed(60.0);
  scenario.tilt.end_angle.reset();  // until it fails
  scenario.output.frame_every = 4.0;
  const Member member = computed(scenario);
  complete_readings(member);
  const io::StoredReading reading = readings_of(member).back();
  ASSERT_EQ(reading.name, "l_min=4");
  const io::RunFile run = io::RunFile::open(member.path);
  const analysis::Analysis analysis =
      runs::analyse_run(run, runs::parse_analysis_settings({reading.name}), 1, {});
  const MemberNumbers numbers = member_numbers(run, analysis);
  const std::vector<std::string> names = documented_columns();
  ASSERT_EQ(reading.values.size(), 2 * names.size());
  int known = 0;
  for (std::size_t k = 0; k < reading.values.size(); ++k) {
    const double expected = number_called(numbers, element_name(names[k % names.size()], k / names.size()));
    known += std::isnan(expected) ? 0 : 1;
    EXPECT_TRUE(reading.values[k] == expected || (std::isnan(reading.values[k]) && std::isnan(expected)))
        << names[k % names.size()];
  }
  EXPECT_GT(known, 6);
}

TEST_F(ReadingsTest, are_none_between_walls) {
  scenario::Scenario scenario = test::small_tilted_bed(1.0);
  scenario.bed.boundary = scenario::BedBoundary::walls;
  const Member member = computed(scenario);
  complete_readings(member);
  EXPECT_TRUE(readings_of(member).empty());
}

EnsembleManifest manifest_with(const std::string& keep) {
  EnsembleManifest manifest;
  manifest.seeds = {3, 5, 8};
  manifest.variants = {{"", "", {}}};
  manifest.keep = keep;
  return manifest;
}

TEST(KeptRuns, are_all_none_or_those_of_the_lowest_seeds) {
  for (const char* all : {"", "all", "3", "4"})
    for (const std::uint64_t seed : {3, 5, 8}) EXPECT_TRUE(keeps_frames(manifest_with(all), seed)) << all;
  for (const char* none : {"analysis", "0"})
    for (const std::uint64_t seed : {3, 5, 8}) EXPECT_FALSE(keeps_frames(manifest_with(none), seed)) << none;
  EXPECT_TRUE(keeps_frames(manifest_with("1"), 3));
  EXPECT_FALSE(keeps_frames(manifest_with("1"), 5));
  EXPECT_TRUE(keeps_frames(manifest_with("2"), 5));
  EXPECT_FALSE(keeps_frames(manifest_with("2"), 8));
}

TEST(KeptRuns, have_no_other_name) {
  for (const char* bad : {"none", "-1", "1.5", "2 ", "frames"})
    EXPECT_EQ(test::exit_code_of([&] { check_keep(bad); }), ExitCode::usage) << bad;
  for (const char* good : {"", "all", "analysis", "0", "12"}) EXPECT_NO_THROW(check_keep(good)) << good;
}

class DroppedFrames : public testing::Test {
 protected:
  /// Returns a plan of members, with the files of the first `count` of them.
  EnsemblePlan plan(const std::string& folder, std::size_t count) {
    EnsembleManifest manifest = manifest_with("");
    manifest.variants[0].scenario = test::small_tilted_bed(1.0);
    EnsemblePlan found = plan_of(manifest, folder_.path(folder));
    fs::create_directories(folder_.path(folder));
    for (std::size_t m = 0; m < count; ++m) run_of(found.members[m]);
    return found;
  }
  std::size_t drop(const std::string& keep, const EnsemblePlan& ensemble, const std::string& folder) {
    return drop_frames(manifest_with(keep), ensemble, folder_.path(folder), known_);
  }

  test::TemporaryFolder folder_;
  KnownMembers known_;
};

TEST_F(DroppedFrames, are_those_of_members_that_are_done_and_the_rest_of_a_run_stays) {
  const EnsemblePlan ensemble = plan("e", 2);
  const std::string path = ensemble.members[0].path;
  EXPECT_EQ(drop("", ensemble, "e"), 0u);
  EXPECT_EQ(drop("2", ensemble, "e"), 0u) << "both seeds keep their frames";
  const MemberResult before = analysed_member(ensemble.members[0], known_);
  EXPECT_TRUE(before.has_frames);
  const std::vector<StepRow> steps = io::RunFile::open(path).steps();
  const std::vector<double> tilts = io::RunFile::open(path).frame_tilts();
  fs::create_directory(io::run_folder(path));
  EXPECT_EQ(drop("analysis", ensemble, "e"), 2u);
  EXPECT_FALSE(fs::exists(io::run_folder(path))) << "remains of a kill are removed";
  EXPECT_EQ(drop("analysis", ensemble, "e"), 0u);
  const io::RunFile run = io::RunFile::open(path);
  EXPECT_FALSE(run.has_frames());
  EXPECT_EQ(run.frame_tilts(), tilts);
  EXPECT_EQ(run.steps(), steps);
  EXPECT_EQ(run.changed_data_sets(), std::vector<std::string>());
  EXPECT_EQ(hash_text(state_hash(run.checkpoint().world)), before.numbers.state_hash);
  for (const auto& read : {&io::RunFile::frame, &io::RunFile::positions})
    EXPECT_EQ(test::exit_code_of([&] { (run.*read)(0); }), ExitCode::missing_input);
  const MemberResult& after = read_member(ensemble.members[0], known_);
  EXPECT_FALSE(after.has_frames);
  ASSERT_EQ(after.numbers.numbers.size(), before.numbers.numbers.size());
  for (std::size_t k = 0; k < before.numbers.numbers.size(); ++k) {
    const double left = before.numbers.numbers[k].second, right = after.numbers.numbers[k].second;
    EXPECT_TRUE(left == right || std::isnan(left)) << before.numbers.numbers[k].first;
  }
  EXPECT_EQ(analysed_member(ensemble.members[0], known_).analysis.frames.size(),
            before.analysis.frames.size());
  EXPECT_LT(fs::file_size(path), fs::file_size(ensemble.members[1].path) * 2) << "both are small";
  io::store_analysis(path, *io::read_analysis(run), before.numbers.state_hash);
  EXPECT_FALSE(io::RunFile::open(path).has_frames()) << "analysed again, it is unchanged";
  EXPECT_EQ(test::exit_code_of([&] { runs::analyse_run(run, analysis::AnalysisParameters(), 1, {}); }),
            ExitCode::missing_input);
}

TEST_F(DroppedFrames, are_none_behind_a_link) {
  plan("victim", 1);
  fs::create_symlink(folder_.path("victim"), folder_.path("e"));
  const EnsemblePlan behind = plan("e", 0);
  fs::create_directory(folder_.path("own"));
  EXPECT_EQ(drop("analysis", behind, "own"), 0u);
  EXPECT_TRUE(io::RunFile::open(folder_.path("victim/seed-3.h5")).has_frames());
  EXPECT_EQ(drop("analysis", behind, "e"), 1u) << "the link itself belongs to the folder";
}

TEST_F(DroppedFrames, are_not_those_of_another_run) {
  const EnsemblePlan ensemble = plan("e", 1);
  fs::rename(ensemble.members[0].path, ensemble.members[1].path);
  EXPECT_EQ(drop("analysis", ensemble, "e"), 0u);
  EXPECT_TRUE(io::RunFile::open(ensemble.members[1].path).has_frames());
}

TEST_F(DroppedFrames, leave_no_folders_and_claims_of_members_that_are_done) {
  const EnsemblePlan ensemble = plan("e", 1);
  for (const std::size_t m : {0u, 1u}) fs::create_directory(io::run_folder(ensemble.members[m].path));
  std::ofstream(claim_path(ensemble.members[0].path, 0)) << "process 1 on host far, boot another\n";
  drop_leftovers(ensemble);
  EXPECT_FALSE(fs::exists(io::run_folder(ensemble.members[0].path)));
  EXPECT_FALSE(fs::exists(claim_path(ensemble.members[0].path, 0)));
  EXPECT_TRUE(fs::exists(io::run_folder(ensemble.members[1].path))) << "of an unfinished member";
}

}  // namespace
}  // namespace talus::ensemble
