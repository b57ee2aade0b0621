#include <gtest/gtest.h>

#include <cmath>

#include "base/errors.h"
#include "core/trigonometry.h"
#include "figures/failed_group.h"
#include "figures/recipes.h"
#include "unit/io/example_run.h"

namespace talus::figures {
namespace {

constexpr std::size_t bins = 2;
constexpr auto density = &analysis::FrameRecord::direction_density;

/// Returns a run that fails at theta_c (deg), with two bins of directions. Their density is `level` in the
/// first frame and 3 `level` in the others.
runs::RunView run_with(const std::string& folder, double theta_c, double level) {
  runs::RunView run = runs::view_of_run(folder, io::RunFile::open(folder), {});
  run.analysis.theta_c = radians(theta_c);
  run.analysis.frames.resize(run.file->frame_count());
  for (std::size_t k = 0; k < run.analysis.frames.size(); ++k)
    run.analysis.frames[k].tilt = run.file->frame_tilts()[k];
  for (analysis::FrameRecord& frame : run.analysis.frames)
    frame.*density = std::vector<double>(bins, &frame == run.analysis.frames.data() ? level : 3.0 * level);
  run.analysis.direction_edge = {0.0, 0.5 * pi, pi};
  run.analysis.gamma_edge = {0.0, 1.0};
  for (analysis::FrameRecord& frame : run.analysis.frames)
    frame.direction_density_by_force = std::vector<double>(bins);
  return run;
}

class ContactFigures : public ::testing::Test {
 protected:
  test::TemporaryFolder folder;
  std::vector<RunGroup> groups;

  void SetUp() override {
    const std::string path = folder.path("run.h5");
    { example::store_with_commits(path, 4); }
    groups.resize(2);
    groups[0].label = "never fails";
    groups[0].runs.push_back(run_with(path, std::nan(""), 1.0));
    groups[1].label = "fails";
    for (const double theta_c : {std::nan(""), 80.0, 80.0})
      groups[1].runs.push_back(run_with(path, theta_c, static_cast<double>(groups[1].runs.size())));
  }
};

TEST_F(ContactFigures, AreOfTheFirstGroupThatHasFailed) {
  const auto failed = first_failed_group(groups);
  ASSERT_TRUE(failed);
  EXPECT_EQ(failed->group, &groups[1]);
  EXPECT_EQ(failed->runs, (RunChoice{&groups[1].runs[1], &groups[1].runs[2]}));
  EXPECT_FALSE(first_failed_group(std::span(groups).first(1)));
  EXPECT_FALSE(contact_directions(std::span(groups).first(1)));
}

TEST_F(ContactFigures, HaveMeansAndErrorsOverTheRuns) {
  const RunChoice runs = {&groups[1].runs[1], &groups[1].runs[2]};
  const std::vector<std::size_t> frames = {0, 1};
  const std::vector<Column> columns = row_means(runs, frames, density, {"density", "1/rad", "", {}});
  ASSERT_EQ(columns.size(), 2u);
  EXPECT_EQ(columns[0].values, (std::vector<double>{3.5, 3.5})) << "of 1 and 6";
  EXPECT_EQ(columns[1].name, "density_error");
  EXPECT_DOUBLE_EQ(columns[1].values[0], 2.5) << "half their difference";
}

TEST_F(ContactFigures, ShowTheFramesThatAreAskedFor) {
  const auto figure = contact_directions(groups, {"frame1", "frame0", "frame2"});
  ASSERT_TRUE(figure);
  std::vector<std::string> names;
  for (const Column& column : figure->tables[0].columns)
    if (column.name.starts_with("density_") && !column.name.ends_with("_error")) {
      names.push_back(column.name);
      EXPECT_EQ(column.values[0], column.name == "density_start" ? 1.5 : 4.5) << column.name;
    }
  EXPECT_EQ(names, (std::vector<std::string>{"density_frame1", "density_start", "density_frame2"}));
  EXPECT_GT(figure->height_over_width, 0.9) << "two rows of roses";
  for (const auto& [word, code] :
       {std::pair{"frame99", ExitCode::bad_data}, {"85", ExitCode::bad_data}, {"five", ExitCode::usage}})
    try {
      contact_directions(groups, {"frame1", word});
      ADD_FAILURE() << word << " accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
    }
}

TEST_F(ContactFigures, ShowOnlyRunsThatHaveTheFrame) {
  groups[1].runs[1].analysis.frames.resize(2);
  const RunChoice runs = {&groups[1].runs[1], &groups[1].runs[2]};
  const std::vector<ShownFrames> shown = shown_frames(runs, {"frame2", "repose"}, {});
  ASSERT_EQ(shown.size(), 2u);
  EXPECT_EQ(shown[0].at.runs, (RunChoice{&groups[1].runs[2]}));
  EXPECT_EQ(shown[1].at.runs, runs);
  EXPECT_EQ(shown[1].label, "before failure");
}

TEST_F(ContactFigures, CompareTheFirstFrameWithTheLastBeforeFailure) {
  const auto figure = contact_directions(groups);
  ASSERT_TRUE(figure);
  EXPECT_EQ(figure->runs.size(), 2u);
  const auto column = [&](const std::string& name) {
    for (const Column& each : figure->tables[0].columns)
      if (each.name == name) return each.values;
    ADD_FAILURE() << name;
    return std::vector<double>{};
  };
  EXPECT_EQ(column("density_start"), (std::vector<double>{1.5, 1.5}));
  EXPECT_EQ(column("density_repose"), (std::vector<double>{4.5, 4.5}));
  EXPECT_EQ(column("direction_from"), (std::vector<double>{0.0, 90.0}));
  EXPECT_EQ(column("direction_to"), (std::vector<double>{90.0, 180.0}));
}

TEST(RoundedText, HasAtMostSoManyDecimals) {
  EXPECT_EQ(rounded_text(13.2501, 2), "13.25");
  EXPECT_EQ(rounded_text(5.000001, 2), "5");
  EXPECT_EQ(rounded_text(-1e-9, 2), "0");
  EXPECT_EQ(angle_text(radians(13.25)), "13.25");
}

}  // namespace
}  // namespace talus::figures
