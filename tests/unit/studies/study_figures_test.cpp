/// Values that a study reads from a run, and its comparison of variations, with a hand-made run of two free
/// grains.

#include "studies/study_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "base/errors.h"
#include "base/hash.h"
#include "core/trigonometry.h"
#include "ensemble/member_state.h"
#include "io/durable_file.h"
#include "studies/study.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace talus::studies {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

Frame frame_at(double tilt, double x, Index image) {
  Frame frame;
  frame.tilt = radians(tilt);
  frame.x = {x, 0.25, 0.5};
  frame.image = {image, 0, 0};
  frame.y = {0.1, 0.1, 0.0};
  frame.gamma = {0.1, 0.1, 1.0};
  frame.angle = frame.vx = frame.vy = frame.omega = {0.0, 0.0, 0.0};
  for (const double each : frame.gamma) frame.internal_moment.push_back({1.0 + each, 0.0, 0.0, 1.0 - each});
  return frame;
}

ObservableRow row_at(double tilt, double volume_strain) {
  ObservableRow row{};
  at(row, Observable::tilt) = radians(tilt);
  at(row, Observable::volume_strain) = volume_strain;
  return row;
}

StepRow step_at(double phase, double iterations) {
  StepRow row{};
  at(row, StepField::phase) = phase;
  at(row, StepField::iterations) = iterations;
  return row;
}

/// Writes a periodic bed, 1 m long and 0.5 m deep, tilted to 3 deg in frames of 1 deg. The first grain creeps
/// by 0.25 m up to 1 deg, across the edge, and by another 0.5 m up to 2 deg.
void write_run(const std::string& path, double theta_c) {
  io::RunHeader header;
  header.statics.free_count = 2;
  header.statics.radius = header.statics.mass = {0.1, 0.1, 0.1};
  header.statics.periodic = true;
  header.statics.length = 1.0;
  header.statics.depth = 0.5;
  header.statics.mean_diameter = 0.2;
  header.scenario_resolved = "seed = 3\n";
  header.provenance = {{"version", "0.0.0"}, {"git_hash", "abc"}};
  io::Segment segment;
  segment.frames = {frame_at(0, 0.875, 0), frame_at(1, 0.125, 1), frame_at(2, 0.625, 1), frame_at(3, 0.0, 2)};
  segment.observables = {row_at(0, 0.0), row_at(1, -0.01), row_at(2, -0.03)};
  segment.steps = {step_at(0, 1000), step_at(1, 100), step_at(1, 300)};
  io::Checkpoint checkpoint;
  checkpoint.world.tilt = radians(3.0);
  checkpoint.world.boundary = {true, header.statics.length, {}};
  for (int i = 0; i < 3; ++i) add_disk(checkpoint.world.grains, {0.1 * i, 0.0}, 0.1, 1.0, i == 2);
  checkpoint.results = {{"theta_c", radians(theta_c)},
                        {"residual_max_rest", 1e-7},
                        {"residual_max_moving", 1e-4},
                        {"unconverged_steps", 1.0}};
  checkpoint.timing = {{"deposition", 2.0}, {"tilt", 3.0}};
  io::RunStore store = io::RunStore::create(path, header, true);
  store.commit(segment, checkpoint);
  store.pack();
}

/// Returns a possible analysis of that run.
ensemble::MemberResult member_of(bool failed) {
  ensemble::MemberResult member;
  member.series = {{0.0, 1.0, 2.0},
                   {{"packing/volume_strain", "1", {0.0, -0.01, -0.03}},
                    {"contacts/coordination_number", "1", {3.0, 4.0, 5.0}}}};
  if (!failed) return member;
  member.series.series.push_back({"overloaded/fraction", "1", {0.5, 1.0, 0.75}});
  member.numbers.numbers = {{"packing/volume_strain@theta_c", "1", -0.04},
                            {"overloaded/fraction@theta_c", "1", 0.7}};
  return member;
}

class StudyFiguresTest : public testing::Test {
 protected:
  StudyFigures figures_of(double theta_c, double reference) const {
    const std::string path = folder_.path("run.h5");
    write_run(path, theta_c);
    return study_figures(io::RunFile::open(path), member_of(!std::isnan(theta_c)), reference);
  }
  test::TemporaryFolder folder_;
};

TEST_F(StudyFiguresTest, are_those_at_the_angle) {
  const StudyFigures found = figures_of(2.5, 1.0);
  EXPECT_DOUBLE_EQ(at(found, StudyQuantity::theta_c), 2.5);
  EXPECT_DOUBLE_EQ(at(found, StudyQuantity::volume_strain_at_reference), -0.01);
  EXPECT_DOUBLE_EQ(at(found, StudyQuantity::coordination_number_at_reference), 4.0);
  EXPECT_DOUBLE_EQ(at(found, StudyQuantity::creep_at_reference), 0.25 / 2 / 0.5)
      << "across the edge, mean of two grains";
  EXPECT_DOUBLE_EQ(at(found, StudyQuantity::overloaded_fraction_at_reference), 1.0);
  EXPECT_DOUBLE_EQ(at(figures_of(2.5, 1.9), StudyQuantity::overloaded_fraction_at_reference), 1.0)
      << "of the previous frame";
}

TEST_F(StudyFiguresTest, at_theta_c_are_the_last_before_the_flow) {
  const StudyFigures found = figures_of(2.5, 1.0);
  EXPECT_DOUBLE_EQ(at(found, StudyQuantity::volume_strain_at_theta_c), -0.04);
  EXPECT_DOUBLE_EQ(at(found, StudyQuantity::creep_at_theta_c), 0.75 / 2 / 0.5);
  EXPECT_DOUBLE_EQ(at(found, StudyQuantity::overloaded_fraction_at_theta_c), 0.7);
}

TEST_F(StudyFiguresTest, of_the_solver_are_those_of_the_tilt) {
  const StudyFigures found = figures_of(2.5, 1.0);
  EXPECT_DOUBLE_EQ(at(found, StudyQuantity::unconverged_share), 0.5);
  EXPECT_DOUBLE_EQ(at(found, StudyQuantity::iterations_per_step), 200.0);
  EXPECT_DOUBLE_EQ(at(found, StudyQuantity::wall_seconds), 5.0);
  EXPECT_DOUBLE_EQ(at(found, StudyQuantity::residual_max_moving), 1e-4);
}

TEST_F(StudyFiguresTest, a_slope_that_failed_before_has_none) {
  const StudyFigures found = figures_of(1.5, 2.0);
  EXPECT_TRUE(std::isnan(at(found, StudyQuantity::volume_strain_at_reference)));
  EXPECT_DOUBLE_EQ(at(found, StudyQuantity::volume_strain_at_theta_c), -0.04);
}

TEST_F(StudyFiguresTest, a_slope_that_stands_has_no_theta_c_and_no_overload) {
  const StudyFigures found = figures_of(none, 2.0);
  EXPECT_TRUE(std::isnan(at(found, StudyQuantity::theta_c)));
  EXPECT_TRUE(std::isnan(at(found, StudyQuantity::overloaded_fraction_at_reference)));
  EXPECT_TRUE(std::isnan(at(found, StudyQuantity::creep_at_theta_c)));
  EXPECT_DOUBLE_EQ(at(found, StudyQuantity::creep_at_reference), 0.75 / 2 / 0.5);
}

TEST(CommonAngle, is_the_smallest_that_all_beds_reach) {
  EXPECT_EQ(common_angle({{16.9, 17.5}, {15.3, 16.0}}), 15.0);
  EXPECT_EQ(common_angle({{none, 3.0000000000000004}, {none, 5.0}}), 3.0);
  EXPECT_EQ(common_angle({{16.9, 17.5}, {none, 12.0}}), 12.0);
  EXPECT_EQ(common_angle({{16.9, 17.5}, {none, 60.0}}), 16.0);
}

/// Returns seeds 3 and 7 of a baseline and one variation.
StudyPlan small_plan(const std::string& folder) {
  return {ensemble::plan_ensemble({3, 7}, {{"baseline", "", {}}, {"other", "", {}}}, folder), "", ""};
}

TEST(StudyResult, pairs_runs_by_their_seeds) {
  StudyResult result{small_plan(""), 1.0, {}};
  const double strains[] = {-0.01, -0.02, -0.05, -0.07};
  for (std::size_t k = 0; k < 4; ++k) {
    result.outcomes.push_back({k, {}, "", ""});
    at(result.outcomes[k].figures, StudyQuantity::volume_strain_at_reference) = strains[k];
  }
  const Comparison other = compare(result, 1, StudyQuantity::volume_strain_at_reference);
  EXPECT_DOUBLE_EQ(other.value.mean, -0.045);
  EXPECT_DOUBLE_EQ(other.difference.mean, -0.015);
  EXPECT_NEAR(other.difference.error, 0.005, 1e-15);
  result.outcomes.erase(result.outcomes.begin() + 2);
  const Comparison unpaired = compare(result, 1, StudyQuantity::volume_strain_at_reference);
  EXPECT_EQ(unpaired.value.count, 2);
  EXPECT_EQ(unpaired.difference.count, 1) << "the baseline lacks seed 7";
}

TEST(StudyResult, is_that_of_the_members_that_are_done) {
  const test::TemporaryFolder folder;
  const StudyPlan plan = small_plan(folder.path());
  for (const char* variation : {"baseline", "other"})
    std::filesystem::create_directories(folder.path(variation));
  write_run(plan.members[1].path, 2.5);
  const StudyResult found = read_study(plan, {});
  ASSERT_EQ(found.outcomes.size(), 1u);
  EXPECT_EQ(found.outcomes[0].member, 1u);
  EXPECT_EQ(found.outcomes[0].version, "0.0.0 (abc)");
  EXPECT_EQ(found.outcomes[0].state_hash,
            hash_text(state_hash(io::RunFile::open(plan.members[1].path).checkpoint().world)));
  EXPECT_EQ(found.reference, 2.0);
  EXPECT_DOUBLE_EQ(at(found.outcomes[0].figures, StudyQuantity::creep_at_reference), 0.75 / 2 / 0.5);
  EXPECT_DOUBLE_EQ(at(found.outcomes[0].figures, StudyQuantity::volume_strain_at_reference), -0.03);
  EXPECT_DOUBLE_EQ(at(found.outcomes[0].figures, StudyQuantity::overloaded_fraction_at_reference), 1.0)
      << "from the analysis: gamma is 0.1, above sin(2.5 deg)";
}

TEST(StudyResult, without_a_member_that_is_done_is_refused) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(read_study(small_plan(folder.path()), {}), Error);
}

TEST(StudyFields, are_documented_as_they_are) {
  std::string expected, found;
  ASSERT_EQ(study_fields().size(), study_quantity_count);
  for (const StudyField& field : study_fields())
    expected += "| `" + field.name + "` | " + field.help + " |\n";
  std::ifstream page(test::source_folder() + "/docs/study.md");
  for (std::string line; std::getline(page, line);)
    if (line.starts_with("| `")) found += line + "\n";
  EXPECT_EQ(found, expected) << "the table of docs/study.md must be:\n" << expected;
}

}  // namespace
}  // namespace talus::studies
